// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <tuple>

#include "engine/graph/builder.h"
#include "engine/graph/documents.h"
#include "engine/graph/flat_graph.h"
#include "engine/graph/graph.h"

namespace engine {

int Graph::find_node(std::string_view id) const {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].id == id) return static_cast<int>(i);
  return -1;
}

GraphReading read_graph(const std::string& path, const std::vector<Setting>& settings, const std::string& folder,
                        const GraphContext& context) {
  GraphReading reading;
  const std::string base = std::filesystem::absolute(folder.empty() ? "." : folder).lexically_normal().string();
  SourceFile working_folder;
  working_folder.folder = base;
  reading.graph.path = resolve_path(working_folder, path);

  Builder builder(context, settings, base, reading.problems);
  const GraphFile& file = builder.documents().read(reading.graph.path, path, {});
  if (file.usable) {
    const FlatGraph flat = builder.build(file, reading.graph);
    analyse_graph(flat, reading.graph, reading.problems);
  }

  // A subgraph that is embedded twice tells of its mistakes twice.
  const auto key = [](const Problem& problem) {
    return std::tie(problem.place.file, problem.place.line, problem.place.column, problem.place.pointer, problem.text);
  };
  std::sort(reading.problems.begin(), reading.problems.end(),
            [&](const Problem& a, const Problem& b) { return key(a) < key(b); });
  const auto same = [&](const Problem& a, const Problem& b) { return key(a) == key(b); };
  reading.problems.erase(std::unique(reading.problems.begin(), reading.problems.end(), same), reading.problems.end());
  return reading;
}

}  // namespace engine
