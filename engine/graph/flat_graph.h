// SPDX-License-Identifier: Apache-2.0
// A graph between its two steps: builder.cpp has put subgraphs, parameters and references in place; analysis.cpp checks
// types and depths and finds out what is absent, in which order nodes stand and what is needed.
#pragma once
#include <string>
#include <vector>

#include "engine/graph/graph.h"
#include "engine/graph/json_tree.h"

namespace engine {

// What a reference leads to. broken: nothing, and that is among the problems already.
struct Link {
  enum class Kind { broken, unset, file, node };
  Kind kind = Kind::broken;
  int node = -1, output = -1;
  std::vector<std::string> element;
  std::string path, shown_path;  // Kind::file
  std::string unset_param;       // Kind::unset: what --set would name
  int input_check = -1;          // the subgraph input it came through, in FlatGraph::input_checks
  Place place;                   // where the reference was written
  Place value_place;             // Kind::file: where the path was written
};

// A subgraph's input and what it was connected to.
struct InputCheck {
  std::string name;
  std::string type;
  int depth = 0;
  Link link;
};

struct FlatNode {
  std::string id;
  const NodeInfo* info = nullptr;  // null: unknown, and reported
  Place place;
  std::vector<std::vector<Link>> ports;
  bool input_missing = false;  // a required input is not given at all, which is reported
  std::vector<ParamValue> params;
  std::vector<Override> overrides;
};

struct FlatOutput {
  std::string name;
  Link link;
  Place place;
};

struct FlatGraph {
  std::vector<FlatNode> nodes;
  std::vector<FlatOutput> outputs;
  std::vector<InputCheck> input_checks;
  bool outputs_reported = false;      // that there is no output has been said
  std::vector<std::string> misspelt;  // parameters that settings mean but do not spell, which has been said
};

// The nodes with producers before consumers, else as written. Rings are reported, each once; on_ring (one per node)
// tells which nodes lie on one.
std::vector<int> find_order(const FlatGraph& flat, std::vector<bool>& on_ring, std::vector<Problem>& problems);

// Checks the graph and puts it into its final form.
void analyse_graph(const FlatGraph& flat, Graph& graph, std::vector<Problem>& problems);

}  // namespace engine
