// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/declare/node_info.h"

namespace engine {

// A plugin's value type as its node list names it.
struct TypeSummary {
  std::string name;
  int codec_version = 1;
  std::string doc;
  std::string layout;
  std::vector<std::pair<std::string, std::string>> views;  // suffix, node
  std::string difference;                                  // node that compares two; may be empty
};

// What stands in the node list beside a plugin (NAME.nodes.json), so that listing it loads nothing.
struct NodeList {
  std::vector<NodeInfo> nodes;
  std::vector<TypeSummary> types;
};

std::string write_node_list(const NodeList& list);
// Throws std::runtime_error with a sentence for what is no node list.
NodeList read_node_list(std::string_view json);

}  // namespace engine
