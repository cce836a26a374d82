// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace engine {

// A parameter's value. Enums travel by the name of their choice.
using ParamValue = std::variant<bool, std::int64_t, double, std::string, std::vector<bool>, std::vector<std::int64_t>,
                                std::vector<double>, std::vector<std::string>>;

enum class ParamKind { boolean, integer, real, string, choice };

struct ParamInfo {
  std::string name;
  std::string doc;
  ParamKind kind = ParamKind::boolean;
  bool list = false;
  std::string unit;                  // "1" where dimensionless; empty for what is no number
  double low = 0, high = 0;          // numbers only, inclusive
  std::vector<std::string> choices;  // ParamKind::choice only
  ParamValue initial;
  std::string inert;  // why changing it may leave the output alone; mostly empty
};

struct InputInfo {
  std::string name;
  std::string doc;
  std::string type;  // name of a value type; empty = any (structural nodes)
  int depth = 0;     // levels of Seq the port takes as a whole
  bool optional = false;
  bool variadic = false;  // takes a list of references (structural nodes)
  bool window = false;    // the element with its neighbours
  int before = 0, after = 0;
};

struct OutputInfo {
  std::string name;
  std::string doc;
  std::string type;  // empty = that of the first input (structural nodes)
  int depth = 0;     // levels of Seq the node adds
};

// How the engine carries out a node that only rearranges. `none` = a plugin's function.
enum class Structural { none, list_files, select, slice, every, where, pick, flatten, merge, ids, first };

// Everything about a node but its code: what a plugin's node list holds, readable without loading it.
struct NodeInfo {
  std::string name;
  int version = 1;
  std::string doc;
  std::vector<InputInfo> inputs;
  std::vector<ParamInfo> params;
  std::vector<OutputInfo> outputs;
  bool cheap = false;             // values are never hashed or stored; recomputed when somebody must read them
  bool prior = false;             // one task per element, in order
  std::int64_t memory_bytes = 0;  // hint: what a task needs beside its inputs and outputs
  int threads = 1;                // hint: threads that the function uses itself
  Structural structural = Structural::none;

  int find_input(std::string_view name) const;  // index, or -1
  int find_param(std::string_view name) const;
  int find_output(std::string_view name) const;
};

// The engine's own nodes: files.list, seq.select, seq.slice, seq.every, seq.where, seq.pick, seq.flatten, seq.merge,
// seq.ids, first.
const std::vector<NodeInfo>& structural_nodes();

// "3", "0.5", "[1, 2]", "\"text\"": as JSON.
std::string to_text(const ParamValue& value);

}  // namespace engine
