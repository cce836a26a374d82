// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/declare/node_info_json.h"

namespace engine {

// The node list of a library that was never loaded before, by loading it in a process of its own: `lister PATH LIST`.
// However that process ends, this one goes on: its exit code, its signal and what it said are the diagnosis. Throws
// std::runtime_error with the reason why the library cannot be used, without its path.
NodeList first_load(const std::string& path, const std::string& lister);

// facegraph_list_nodes beside the running program.
std::string lister_beside_this_program();

}  // namespace engine
