// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "engine/run/run.h"

namespace cli {
namespace {

const char* word(engine::PlannedTask::Fate fate) {
  using Fate = engine::PlannedTask::Fate;
  switch (fate) {
    case Fate::cached:
      return "cached";
    case Fate::runs:
      return "will run";
    case Fate::may_run:
      return "may run";
    case Fate::unknown_length:
      return "length unknown";
  }
  return "";
}

}  // namespace

int plan(const Common& common, const PlanArguments& arguments) {
  const auto plugins = open_plugins(common);
  engine::Graph graph;
  if (!read_graph(arguments.graph, *plugins, graph)) return invalid;
  const auto store = open_store(common);
  const engine::Plan planned = engine::plan_graph(graph, *plugins, *store);
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const engine::PlannedTask& task : planned.tasks) {
    if (task.fate == engine::PlannedTask::Fate::cached && !arguments.all) continue;
    const std::string name = task.node + (task.element.empty() ? "" : "[" + task.element + "]");
    if (arguments.json) {
      list.push_back({{"task", name}, {"type", task.type}, {"fate", word(task.fate)}, {"depends_on", task.depends_on}});
      continue;
    }
    std::string note;
    if (task.fate == engine::PlannedTask::Fate::may_run) note = " (depends on " + task.depends_on + ")";
    if (task.fate == engine::PlannedTask::Fate::unknown_length) note = " until " + task.depends_on + " ran";
    std::printf("%-14s %s  %s%s\n", word(task.fate), name.c_str(), task.type.c_str(), note.c_str());
  }
  if (arguments.json)
    std::printf(
        "%s\n",
        nlohmann::ordered_json{
            {"tasks", list}, {"cached", planned.cached}, {"will_run", planned.runs}, {"may_run", planned.may_run}}
            .dump(2)
            .c_str());
  else
    std::printf("%zu cached, %zu will run, %zu may run\n", planned.cached, planned.runs, planned.may_run);
  return done;
}

}  // namespace cli
