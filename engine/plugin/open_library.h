// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "engine/declare/call.h"
#include "engine/declare/node_info_json.h"

namespace engine {

// Compares the tags in a library's file with this engine's; runs no code of it. Throws std::runtime_error with the
// reason why it cannot be used, without its path.
void check_tags(const std::string& path);

// Loads a library, for the life of the process, every symbol resolved, and asks it for its nodes. Throws as check_tags.
std::vector<NodeDeclaration> open_library(const std::string& path);

// What stands in the node list of these nodes.
NodeList list_of(const std::vector<NodeDeclaration>& nodes);

// "plugin PATH cannot be used: ", the start of what a PluginError says.
std::string unusable(const std::string& path);

}  // namespace engine
