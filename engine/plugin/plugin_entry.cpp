// SPDX-License-Identifier: Apache-2.0
// Compiled into every plugin: its tags and its descriptor. The nodes are the entries that NODE left in a linker
// section.
#include "engine/declare/node.h"
#include "engine/plugin/descriptor.h"

extern "C" {
__attribute__((visibility("hidden"))) extern const engine::NodeEntry __start_facegraph_nodes;
__attribute__((visibility("hidden"))) extern const engine::NodeEntry __stop_facegraph_nodes;
}

namespace {

[[gnu::used, gnu::section("facegraph_tags")]] constinit const engine::PluginTags tags = engine::this_abi;

std::vector<engine::NodeDeclaration> nodes() {
  std::vector<engine::NodeDeclaration> list;
  for (const engine::NodeEntry* entry = &__start_facegraph_nodes; entry != &__stop_facegraph_nodes; ++entry)
    list.push_back((*entry)());
  return list;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) constinit const engine::PluginDescriptor facegraph_plugin = {&nodes};
