// SPDX-License-Identifier: Apache-2.0
// Graph files in a folder of their own, for tests of reading them.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "engine/graph/graph.h"
#include "tests/support/toy_catalogue.h"

namespace test {

class GraphFiles {
 public:
  GraphFiles() {
    static int count = 0;
    folder_ = std::filesystem::temp_directory_path() /
              ("graph_files_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
  }
  ~GraphFiles() { std::filesystem::remove_all(folder_); }
  GraphFiles(const GraphFiles&) = delete;
  GraphFiles& operator=(const GraphFiles&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // Reads a graph of the folder as if it were the working directory.
  engine::GraphReading read(const std::string& name, const std::vector<engine::Setting>& settings = {}) const {
    return engine::read_graph(name, settings, folder_.string(), catalogue.context());
  }
  // The same, its problems as lines.
  std::string problems(const std::string& name, const std::vector<engine::Setting>& settings = {}) const {
    std::string text;
    for (const engine::Problem& problem : read(name, settings).problems) text += problem.line() + "\n";
    return text;
  }
  // A graph of these nodes and outputs, as "graph.json".
  std::string problems_of(const std::string& nodes, const std::string& outputs) const {
    write("graph.json", "{\"facegraph\": 1, \"nodes\": {" + nodes + "},\n\"outputs\": {" + outputs + "}}");
    return problems("graph.json");
  }

  ToyCatalogue catalogue;

 private:
  std::filesystem::path folder_;
};

}  // namespace test
