// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/commands.h"
#include "engine/describe/describe.h"

namespace cli {

int nodes(const Common& common, const NodesArguments& arguments) {
  const auto plugins = open_plugins(common);
  if (arguments.markdown) {
    std::printf("%s", engine::node_reference(*plugins).c_str());
    return done;
  }
  engine::NodeList list;
  for (const std::string& name : plugins->node_names()) {
    const engine::NodeInfo& node = *plugins->find(name);
    if (!arguments.filter.empty() && name.find(arguments.filter) == std::string::npos &&
        node.doc.find(arguments.filter) == std::string::npos)
      continue;
    list.nodes.push_back(node);
    if (!arguments.json) std::printf("%-28s %s\n", name.c_str(), node.doc.c_str());
  }
  if (arguments.json) std::printf("%s", engine::write_node_list(list).c_str());
  if (!list.nodes.empty() || arguments.filter.empty()) return done;
  std::fprintf(stderr, "no node has '%s' in its name or its text\n", arguments.filter.c_str());
  return invalid;
}

}  // namespace cli
