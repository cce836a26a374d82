// SPDX-License-Identifier: Apache-2.0
#include "engine/run/inspect.h"

#include <filesystem>

#include "engine/run/session.h"

namespace engine {
namespace {

using run::Session;
using run::Task;
using run::Tree;

// Returns false where something is missing.
bool collect(Tree* tree, const std::string& path, StoredOutput& output) {
  tree = run::follow(tree);
  if (tree->state == Tree::State::leaf && tree->has_identity) {
    output.leaves.push_back({path, tree->identity});
    return true;
  }
  if (tree->state != Tree::State::sequence) return false;
  bool complete = tree->sequence->complete && !tree->broken;
  for (std::size_t i = 0; i < tree->sequence->children.size(); ++i)
    complete &= collect(tree->sequence->children[i],
                        path.empty() ? tree->sequence->ids[i] : path + "/" + tree->sequence->ids[i], output);
  return complete;
}

}  // namespace

std::vector<StoredNode> inspect_graph(const Graph& graph, Plugins& plugins, Store& store) {
  const RunOptions options;
  Session session(graph, plugins, store, options, Session::Mode::plan);
  session.expand();
  std::vector<StoredNode> nodes(graph.nodes.size());
  for (const Task& task : session.tasks()) {
    StoredNode& node = nodes[static_cast<std::size_t>(task.node)];
    ++node.tasks;
    if (task.key.empty() || task.state != Task::State::known) continue;
    const auto record = store.find(task.key);
    if (!record) continue;
    ++node.stored;
    node.seconds += record->seconds;
    for (const std::string& warning : record->warnings)
      node.warnings.push_back(task.element.empty() ? warning : task.element + ": " + warning);
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (!graph.nodes[n].needed) continue;
    for (Tree* tree : session.node_outputs(static_cast<int>(n))) {
      StoredOutput& output = nodes[n].outputs.emplace_back();
      output.cheap = graph.nodes[n].info->cheap;
      output.complete = tree && collect(tree, "", output);
    }
  }
  return nodes;
}

std::optional<Value> stored_value(const std::string& name, const Digest& identity, Plugins& plugins, Store& store) {
  const TypeInfo* type = nullptr;
  for (const TypeInfo* builtin :
       {&type_of<double>(), &type_of<std::int64_t>(), &type_of<bool>(), &type_of<std::string>(), &type_of<File>()})
    if (builtin->name == name) type = builtin;
  if (!type) type = plugins.load_type(name);
  return type ? run::load_value(*type, identity, store) : std::nullopt;
}

std::int64_t stored_bytes(const std::string& type, const Digest& identity, Store& store) {
  if (type == "file") {
    const run::StoredFile file = run::stored_file(identity, store);
    const std::string path = file.known ? store.file_path(file.content, file.suffix) : std::string();
    std::error_code error;
    const auto size = path.empty() ? 0 : std::filesystem::file_size(path, error);
    return path.empty() || error ? -1 : static_cast<std::int64_t>(size);
  }
  const auto bytes = store.get(identity);
  return bytes ? static_cast<std::int64_t>(bytes->size()) : -1;
}

}  // namespace engine
