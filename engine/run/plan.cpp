// SPDX-License-Identifier: Apache-2.0
// What a run would do.
#include <algorithm>
#include <utility>

#include "engine/run/run.h"
#include "engine/run/upstream.h"

namespace engine {
using run::Session;
using run::Task;
using run::Tree;
namespace {

std::string first_unknown(const Session& session, const Task& task) {
  for (Tree* tree : run::inputs_of(task)) {
    if (!tree->unknown) continue;
    run::TaskSet producers;
    run::producers_of(tree, producers);
    for (const Task* producer : producers)
      if (producer->state == Task::State::would_run) return session.name_of(*producer);
  }
  return {};
}

}  // namespace

Plan plan_graph(const Graph& graph, Plugins& plugins, Store& store) {
  const RunOptions options;
  Session session(graph, plugins, store, options, Session::Mode::plan);
  session.expand();
  Plan plan;
  std::vector<std::pair<std::size_t, PlannedTask>> entries;  // by the node's place in the graph
  std::vector<bool> seen(graph.nodes.size(), false);
  for (const Task& task : session.tasks()) {
    seen[static_cast<std::size_t>(task.node)] = true;
    if (session.node(task.node).info->cheap && task.state == Task::State::known) continue;
    const GraphNode& node = session.node(task.node);
    PlannedTask entry{run::fate_of(task), node.id, node.info->name, task.element, ""};
    if (entry.fate == PlannedTask::Fate::may_run) entry.depends_on = first_unknown(session, task);
    (entry.fate == PlannedTask::Fate::cached ? plan.cached
     : entry.fate == PlannedTask::Fate::runs ? plan.runs
                                             : plan.may_run) += 1;
    entries.emplace_back(static_cast<std::size_t>(task.node), std::move(entry));
  }
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    const GraphNode& node = graph.nodes[n];
    if (!node.needed || seen[n] || node.info->structural != Structural::none || node.mapped_depth == 0) continue;
    PlannedTask entry{PlannedTask::Fate::unknown_length, node.id, node.info->name, "", ""};
    for (std::size_t p = 0; p < node.inputs.size(); ++p)
      for (const Source& source : node.inputs[p])
        if (entry.depends_on.empty() && source.kind == Source::Kind::node &&
            node.input_depth[p] > node.info->inputs[p].depth)
          entry.depends_on = graph.nodes[static_cast<std::size_t>(source.node)].id;
    entries.emplace_back(n, std::move(entry));
  }
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [place, entry] : entries) plan.tasks.push_back(std::move(entry));
  return plan;
}

}  // namespace engine
