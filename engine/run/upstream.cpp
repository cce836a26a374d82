// SPDX-License-Identifier: Apache-2.0
#include "engine/run/upstream.h"

#include <stdexcept>

namespace engine::run {

Graph reduced_to(const Graph& graph, int target) {
  Graph reduced = graph;
  reduced.outputs.clear();
  for (GraphNode& node : reduced.nodes) node.needed = false;
  reduced.nodes[static_cast<std::size_t>(target)].needed = true;
  for (std::size_t n = reduced.nodes.size(); n-- > 0;) {
    if (!reduced.nodes[n].needed) continue;
    for (const auto& port : reduced.nodes[n].inputs)
      for (const Source& source : port) {
        if (source.kind == Source::Kind::node) reduced.nodes[static_cast<std::size_t>(source.node)].needed = true;
        if (reduced.nodes[n].info->structural == Structural::first)
          break;  // the alternatives behind it are not looked at
      }
  }
  return reduced;
}

int find_or_throw(const Graph& graph, const std::string& id) {
  const int index = graph.find_node(id);
  if (index >= 0) return index;
  std::vector<std::string> names;
  std::string inside;
  for (const GraphNode& node : graph.nodes) {
    names.push_back(node.id);
    if (node.id.starts_with(id + "/")) inside += (inside.empty() ? "" : ", ") + node.id;
  }
  if (!inside.empty())
    throw std::invalid_argument("'" + id + "' is a subgraph, expected one of its nodes: " + inside);
  throw std::invalid_argument("the graph has no node '" + id + "'" + did_you_mean(id, names));
}

std::vector<Tree*> inputs_of(const Task& task) {
  std::vector<Tree*> trees;
  for (const auto& port : task.inputs)
    for (const Binding& binding : port)
      if (binding.tree) trees.push_back(binding.tree);
  if (task.prior) trees.insert(trees.end(), task.prior->outputs.begin(), task.prior->outputs.end());
  return trees;
}

void producers_of(Tree* tree, TaskSet& found) {
  tree = follow(tree);
  if (tree->producer) {
    found.insert(tree->producer);
  } else if (tree->state == Tree::State::sequence) {
    for (Tree* child : tree->sequence->children) producers_of(child, found);
  }
}

PlannedTask::Fate fate_of(const Task& task) {
  if (task.state == Task::State::known) return PlannedTask::Fate::cached;
  return task.key.empty() ? PlannedTask::Fate::may_run : PlannedTask::Fate::runs;
}

}  // namespace engine::run
