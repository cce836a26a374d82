// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "engine/plugin/plugins.h"

namespace engine {

// Everything about a node, as plain text for a terminal.
std::string describe_node(const NodeInfo& node, const std::string& plugin);
std::string describe_type(const TypeSummary& type, const Plugins& plugins);

// The reference page of all nodes, as Markdown.
std::string node_reference(const Plugins& plugins);

// The JSON Schema (draft 2020-12) of graph files, with every installed node's ports, parameters, ranges and texts.
std::string graph_schema(const Plugins& plugins);

// "Seq<image>", "image".
std::string port_type(const std::string& type, int depth);

}  // namespace engine
