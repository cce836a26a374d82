// SPDX-License-Identifier: Apache-2.0
#include "engine/describe/describe.h"

#include <cstdio>

#include "cli/commands.h"
#include "engine/base/problem.h"

namespace cli {

int describe(const Common& common, const DescribeArguments& arguments) {
  const auto plugins = open_plugins(common);
  if (const engine::NodeInfo* node = plugins->find(arguments.name)) {
    if (arguments.json)
      std::printf("%s", engine::write_node_list({{*node}, {}}).c_str());
    else
      std::printf("%s", engine::describe_node(*node, plugins->plugin_of(arguments.name)).c_str());
    return done;
  }
  const auto type = plugins->types().find(arguments.name);
  if (type != plugins->types().end()) {
    std::printf("%s", engine::describe_type(type->second, *plugins).c_str());
    return done;
  }
  std::vector<std::string> names = plugins->node_names();
  for (const auto& [name, summary] : plugins->types()) names.push_back(name);
  std::fprintf(stderr, "there is no node or type '%s'%s\n", arguments.name.c_str(),
               engine::did_you_mean(arguments.name, names).c_str());
  return invalid;
}

}  // namespace cli
