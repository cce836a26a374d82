// SPDX-License-Identifier: Apache-2.0
// A folder, a store and the toy plugin: writes graphs and files, runs them, and hands back the counts.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "engine/graph/graph.h"
#include "engine/plugin/plugins.h"
#include "engine/run/run.h"
#include "engine/store/store.h"

namespace test {

// A folder that goes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "facegraph-test-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// For reading graphs of these plugins' nodes; keeps a reference to them.
inline engine::GraphContext context_of(engine::Plugins& plugins) {
  engine::GraphContext context;
  context.find_node = [&](std::string_view name) { return plugins.find(name); };
  context.node_names = [&] { return plugins.node_names(); };
  context.absent_plugin = [](std::string_view) { return std::string(); };
  return context;
}

class ToyRun : public ::testing::Test {
 protected:
  ToyRun() : plugins_({FACEGRAPH_PLUGIN_DIR}), store_(engine::Store::open((folder() / "store").string())) {}

  std::filesystem::path folder() const { return folder_.path(); }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder() / name).parent_path());
    std::ofstream(folder() / name, std::ios::binary) << text;
  }
  // frames/1.txt ... frames/COUNT.txt
  void write_frames(int count) const {
    for (int i = 1; i <= count; ++i) write("frames/" + std::to_string(i) + ".txt", "frame " + std::to_string(i));
  }

  // Nodes and outputs, as JSON inside the braces of a graph; the folder "frames" is ${folder}.
  engine::Graph graph(const std::string& nodes, const std::string& outputs,
                      const std::vector<engine::Setting>& settings = {}) {
    write("graph.json",
          "{\"facegraph\": 1, \"params\": {\"folder\": {\"type\": \"path\", \"default\": \"frames\"}},\n\"nodes\": {" +
              nodes + "},\n\"outputs\": {" + outputs + "}}");
    return read((folder() / "graph.json").string(), settings);
  }
  engine::Graph read(const std::string& path, const std::vector<engine::Setting>& settings = {}) {
    engine::GraphReading reading = engine::read_graph(path, settings, folder().string(), context_of(plugins_));
    for (const engine::Problem& problem : reading.problems) ADD_FAILURE() << problem.line();
    return reading.graph;
  }

  engine::RunResult run(const engine::Graph& graph, engine::RunOptions options = {}) {
    options.out_folder = (folder() / "out").string();
    return engine::run_graph(graph, plugins_, *store_, options);
  }
  std::string out(const std::string& name) const { return read_file(folder() / "out" / name); }

  TemporaryFolder folder_;
  engine::Plugins plugins_;
  std::shared_ptr<engine::Store> store_;
};

}  // namespace test
