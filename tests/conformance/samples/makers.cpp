// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <tuple>

#include "engine/port.h"
#include "nodes/types/matrix.h"
#include "tests/conformance/node_samples.h"
#include "tests/conformance/samples/area_samples.h"
#include "tests/support/samples.h"

namespace conformance {
namespace {

// What a node makes of its own samples, without files that it can do without; called once for each variant.
const Outcome* outcome_of(engine::Plugins& plugins, const std::string& node, int variant) {
  static std::map<std::tuple<const engine::Plugins*, std::string, int>, Outcome> made;
  const auto key = std::make_tuple(&plugins, node, variant);
  if (const auto at = made.find(key); at != made.end()) return &at->second;
  if (!plugins.find(node)) return nullptr;
  const engine::NodeDeclaration& declaration = plugins.load(node);
  PortValues inputs;
  for (std::size_t p = 0; p < declaration.info.inputs.size(); ++p) {
    const engine::InputInfo& port = declaration.info.inputs[p];
    const auto input = port.optional && port.type == "file" ? PortValue{true, {}, {}, {}}
                                                            : port_sample(plugins, declaration, p, variant);
    if (!input) return nullptr;
    inputs.push_back(*input);
  }
  Outcome outcome = call_node(declaration, inputs, sample_params(declaration.info));
  if (outcome.threw) throw std::runtime_error("the sample that " + node + " makes: " + outcome.what);
  return &made.emplace(key, std::move(outcome)).first->second;
}

std::vector<Sample> output_of(engine::Plugins& plugins, const std::string& node, const std::string& output,
                              int variant) {
  const Outcome* outcome = outcome_of(plugins, node, variant);
  if (!outcome) return {{}};
  const engine::NodeDeclaration& declaration = plugins.load(node);
  const auto o = static_cast<std::size_t>(declaration.info.find_output(output));
  std::vector<Sample> samples;
  for (const AnyValue& value : outcome->values.at(o)) samples.push_back({value, declaration.output_types.at(o)->name});
  return samples;
}

}  // namespace

Maker another(const std::string& type, int by) {
  return [type, by](engine::Plugins&, int variant) { return Sample{test::sample(type, variant + by), type}; };
}

Maker made_by(const std::string& node, const std::string& output) {
  return
      [node, output](engine::Plugins& plugins, int variant) { return output_of(plugins, node, output, variant).at(0); };
}

SequenceMaker sequence_by(const std::string& node, const std::string& output) {
  return [node, output](engine::Plugins& plugins, int variant) { return output_of(plugins, node, output, variant); };
}

Maker file_by(const std::string& node) {
  return [node](engine::Plugins& plugins, int variant) -> Sample {
    const engine::NodeInfo* info = plugins.find(node);
    if (!info) return {};
    const Sample sample = output_of(plugins, node, info->outputs[0].name, variant).at(0);
    const auto& file = *static_cast<const engine::File*>(sample.value.get());
    if (!file.in_memory()) return sample;
    return {test::sample_file(node + std::to_string(variant) + file.suffix(), file.bytes()), "file"};
  };
}

Maker text_file(const std::string& suffix, std::vector<std::string> texts) {
  return [suffix, texts](engine::Plugins&, int variant) {
    const auto at = static_cast<std::size_t>(variant) % texts.size();
    const std::string name = "sample" + std::to_string(std::hash<std::string>()(texts[at])) + suffix;
    return Sample{test::sample_file(name, texts[at]), "file"};
  };
}

Maker matrices(std::size_t rows, std::size_t columns) {
  return made([=](int variant) {
    face::Matrix matrix{rows, columns, {}};
    for (std::size_t i = 0; i < rows * columns; ++i)
      matrix.values.push_back(1.5 + std::sin(1.7 * static_cast<double>(i) + 0.1 * variant));
    return matrix;
  });
}

Maker columns_of(std::vector<std::vector<double>> lists) {
  return made([lists](int variant) {
    const std::vector<double>& list = lists[static_cast<std::size_t>(variant) % lists.size()];
    return face::Matrix{list.size(), 1, list};
  });
}

}  // namespace conformance
