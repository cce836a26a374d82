// SPDX-License-Identifier: Apache-2.0
// What an area's nodes are called with where a sample of the port's type (tests/support/samples.cpp) does not do: one
// file per area beside this one, which puts its part into one `AreaSamples`. A new area gets a new file and nothing
// else; names that no node has are found by the suite.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/plugin/plugins.h"
#include "engine/value/type_info.h"
#include "tests/conformance/node_call.h"

namespace conformance {

// A value with the name of its type; null where it cannot be had.
struct Sample {
  AnyValue value;
  std::string type;
};

// Makes the sample of a port; each of the variants 0, 1, 2, ... differs from the others. The elements of a sequence
// are variants that follow each other.
using Maker = std::function<Sample(engine::Plugins&, int variant)>;

using SequenceMaker = std::function<std::vector<Sample>(engine::Plugins&, int variant)>;

using ParamValues = std::map<std::string, engine::ParamValue>;

struct AreaSamples {
  // By "node.port".
  std::map<std::string, Maker> inputs = {};
  // By a type that only a node can make.
  std::map<std::string, Maker> types = {};
  // By "node.port" of a sequence: how many elements it has. 4 unless told.
  std::map<std::string, int> lengths = {};
  // By "node.port" of a sequence whose elements belong together, in place of inputs.
  std::map<std::string, SequenceMaker> sequences = {};
  // By "node.port" of a node that reads its own result at the preceding element: what it was given there.
  std::map<std::string, Maker> before = {};
  // By "node.parameter": what samples need set, as they are too small, or too large, for the default.
  ParamValues params = {};
  // By "node.parameter": values to try beside the usual ones, first.
  std::map<std::string, std::vector<engine::ParamValue>> values = {};
  // By node: settings of parameters in which the others and the inputs are tried too, beside each switch and choice.
  std::map<std::string, std::vector<ParamValues>> settings = {};
  // By "node.parameter" or "node.port": why it does not count with any samples. The suite fails when it does count.
  std::map<std::string, std::string> shown_elsewhere = {};
  // By "node.parameter" or "node.port" that some values are refused for and no result depends on: why. The suite fails
  // when one does.
  std::map<std::string, std::string> only_refuses = {};
  // By node that breaks a rule on purpose: what is found, all of it.
  std::map<std::string, std::vector<std::string>> sins = {};
};

// Puts an area's samples among those of all areas; as a constant of a file. A name that is there already throws.
struct Registered {
  explicit Registered(AreaSamples area);
};
const AreaSamples& all_samples();

// Makers.

template <class T>
Sample held(T value) {
  return {std::make_shared<const T>(std::move(value)), engine::type_of<T>().name};
}
// Of a function of the variant.
template <class F>
Maker made(F make) {
  return [make](engine::Plugins&, int variant) { return held(make(variant)); };
}
// The sample of a type, some variants farther on.
Maker another(const std::string& type, int by = 1);
// An output of another node, called with its own samples: its value (of a sequence the first), or all its elements.
Maker made_by(const std::string& node, const std::string& output);
SequenceMaker sequence_by(const std::string& node, const std::string& output);
// What another node's first output is, as a file on disk.
Maker file_by(const std::string& node);
// A file with one of these texts; the variants take them in turn.
Maker text_file(const std::string& suffix, std::vector<std::string> texts);
// Smooth numbers from 0.5 to 2.5.
Maker matrices(std::size_t rows, std::size_t columns);
// One of these lists as a column; the variants take them in turn.
Maker columns_of(std::vector<std::vector<double>> lists);

// A sample's value, to make another of.
template <class T>
T value_of(const Maker& maker, engine::Plugins& plugins, int variant) {
  const Sample sample = maker(plugins, variant);
  if (sample.type != engine::type_of<T>().name)
    throw std::logic_error("a sample is " + sample.type + ", expected " + engine::type_of<T>().name);
  return *static_cast<const T*>(sample.value.get());
}
// A maker's values, each changed by a function of the value and the variant.
template <class T, class F>
Maker changed(Maker maker, F change) {
  return [maker, change](engine::Plugins& plugins, int variant) {
    T value = value_of<T>(maker, plugins, variant);
    change(value, variant);
    return held(std::move(value));
  };
}

inline engine::ParamValue whole(std::int64_t value) { return value; }
inline engine::ParamValue text(std::string value) { return value; }

}  // namespace conformance
