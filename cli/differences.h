// SPDX-License-Identifier: Apache-2.0
// How values and files differ, for the command compare: by what value types and plugins say, else number by number.
#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/preview.h"
#include "engine/describe/view.h"
#include "engine/graph/graph.h"
#include "engine/run/inspect.h"

namespace cli {

// What was found out about one output, or one file.
struct Found {
  std::shared_ptr<nlohmann::ordered_json> json;  // null: equal
  std::string html;                              // pictures, curves and tables for a page
};

class Differences {
 public:
  // folders: where plugins lie; the graphs in `differences` below them compare files. all: name every element.
  Differences(engine::Plugins& plugins, engine::Store& store, std::vector<std::string> folders, bool all)
      : plugins_(plugins), store_(store), folders_(std::move(folders)), all_(all), previews_(plugins, store) {}

  // Values of one output, of a type by name. Those that differ are compared by the difference that the type names, else
  // number by number in their JSON form; files by file().
  Found outputs(const std::string& type, const engine::StoredOutput& a, const engine::StoredOutput& b);
  // Two files: by the graph differences/SUFFIX.json of a plugin, else as JSON or line by line, else by size.
  Found files(const std::string& a, const std::string& b, const std::string& suffix);

 private:
  class Pairs;
  std::string graph_for(const std::string& suffix) const;
  std::vector<std::pair<std::string, Pairs>> by_graph(const std::string& graph, const std::string& a,
                                                      const std::string& b);

  engine::Plugins& plugins_;
  engine::Store& store_;
  std::vector<std::string> folders_;
  bool all_;
  Previews previews_;
};

// One line of what was found: "83 of 83 values differ; most at [67]: largest 0.72, rms 0.02".
std::string line_of(const nlohmann::ordered_json& difference);

}  // namespace cli
