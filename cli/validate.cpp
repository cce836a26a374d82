// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/commands.h"

namespace cli {

int validate(const Common& common, const GraphArguments& arguments) {
  const auto plugins = open_plugins(common);
  engine::Graph graph;
  if (!read_graph(arguments, *plugins, graph)) return invalid;
  std::printf("%s: %zu nodes, %zu outputs, no problem\n", arguments.path.c_str(), graph.nodes.size(),
              graph.outputs.size());
  return done;
}

}  // namespace cli
