// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "engine/graph/graph.h"
#include "engine/plugin/plugins.h"
#include "engine/store/store.h"

namespace cli {

// Exit codes.
enum Exit { done = 0, task_failed = 1, invalid = 2, plugin_problem = 3, interrupted = 130 };

// What every command takes.
struct Common {
  std::vector<std::string> plugin_folders;  // besides the installed one
  std::string store;                        // empty = FACEGRAPH_STORE, else the user's cache folder
  std::string store_limit;                  // "50GB"; empty = FACEGRAPH_STORE_LIMIT, else 50 GB
};

struct GraphArguments {
  std::string path;
  std::vector<std::string> sets;  // NAME=VALUE
};

// Where plugins are looked for, in order: --plugins, FACEGRAPH_PLUGINS, the installed ones.
std::vector<std::string> plugin_folders(const Common& common);
std::unique_ptr<engine::Plugins> open_plugins(const Common& common);
std::shared_ptr<engine::Store> open_store(const Common& common);

// Reads a graph with settings, against these plugins.
engine::GraphReading read_graph(const std::string& path, const std::vector<engine::Setting>& settings,
                                const engine::Plugins& plugins);

// Reads the graph; prints every problem and returns false where there are any.
bool read_graph(const GraphArguments& arguments, const engine::Plugins& plugins, engine::Graph& graph);

// Splits "node.output[17]"; prints what is wrong and returns false.
bool read_reference(const std::string& text, engine::Reference& reference);

}  // namespace cli
