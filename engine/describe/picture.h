// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <string>
#include <vector>

#include "engine/graph/graph.h"

namespace engine {

// What a picture says in a node's box, besides its name and kind.
struct BoxNote {
  std::vector<std::string> lines;
  std::string tone;  // "reused", "run", "failed", or empty
  std::string link;  // "#flow"
};

// A graph as an SVG picture: files, nodes and outputs as boxes from left to right, an arrow for every connection. No
// scripts, nothing from elsewhere. Nodes that no output needs are pale. notes: by node id.
std::string graph_svg(const Graph& graph, const std::map<std::string, BoxNote>& notes = {});

// The same for Graphviz.
std::string graph_dot(const Graph& graph);

// Text inside of HTML and SVG.
std::string escape_markup(std::string_view text);

}  // namespace engine
