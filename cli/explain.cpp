// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "engine/run/run.h"

namespace cli {

int explain(const Common& common, const ExplainArguments& arguments) {
  const auto plugins = open_plugins(common);
  engine::Graph graph;
  if (!read_graph(arguments.graph, *plugins, graph)) return invalid;
  engine::Reference reference;
  if (!read_reference(arguments.task, reference)) return invalid;
  const auto store = open_store(common);
  std::string element;
  for (const std::string& id : reference.element) element += (element.empty() ? "" : "/") + id;
  const auto explanations = engine::explain_node(graph, *plugins, *store, reference.node, element);
  if (explanations.empty() && !element.empty()) {
    std::fprintf(stderr, "node '%s' has no element '%s', or its length is not known before what it depends on ran\n",
                 reference.node.c_str(), element.c_str());
    return invalid;
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  std::size_t unchanged = 0;
  for (const engine::Explanation& explanation : explanations) {
    if (explanation.causes.empty() && explanations.size() > 1) {
      ++unchanged;
      continue;
    }
    nlohmann::ordered_json causes = nlohmann::ordered_json::array();
    if (!arguments.json)
      std::printf("%s: %s\n", explanation.task.c_str(),
                  explanation.causes.empty()                              ? "nothing changed since it last ran"
                  : explanation.fate == engine::PlannedTask::Fate::cached ? "changed, but the result is in the store"
                                                                          : "runs again");
    for (const engine::Cause& cause : explanation.causes) {
      causes.push_back({{"task", cause.task}, {"what", cause.what}, {"path", cause.path}, {"others", cause.others}});
      if (arguments.json) continue;
      std::printf("  because of %s: %s\n", cause.task.c_str(), cause.what.c_str());
      if (cause.others > 0) std::printf("    and of %zu more of its elements\n", cause.others);
      if (cause.path.size() > 1) {
        std::printf("    by way of");
        for (std::size_t i = 0; i < cause.path.size(); ++i)
          std::printf("%s %s", i == 0 ? "" : " ->", cause.path[i].c_str());
        std::printf("\n");
      }
    }
    list.push_back({{"task", explanation.task},
                    {"cached", explanation.fate == engine::PlannedTask::Fate::cached},
                    {"seen_before", explanation.seen_before},
                    {"causes", causes}});
  }
  if (arguments.json)
    std::printf("%s\n", list.dump(2).c_str());
  else if (unchanged > 0)
    std::printf("%zu elements unchanged\n", unchanged);
  return done;
}

}  // namespace cli
