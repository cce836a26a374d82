// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/experiments.h"
#include "engine/describe/picture.h"

namespace cli {

int graph_picture(const Common& common, const GraphPictureArguments& arguments) {
  const auto plugins = open_plugins(common);
  engine::Graph graph;
  if (!read_graph(arguments.graph, *plugins, graph)) return invalid;
  const std::string picture = arguments.dot ? engine::graph_dot(graph) : engine::graph_svg(graph);
  if (arguments.out.empty())
    std::fwrite(picture.data(), 1, picture.size(), stdout);
  else
    write_whole(arguments.out, picture);
  return done;
}

}  // namespace cli
