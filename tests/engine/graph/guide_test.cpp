// SPDX-License-Identifier: Apache-2.0
// The samples of docs/graph-files.md are read as they stand there.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "engine/graph/json_tree.h"
#include "tests/support/graph_files.h"

namespace {

std::vector<std::string> samples() {
  std::ifstream stream(FACEGRAPH_SOURCE_DIR "/docs/graph-files.md", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string fence = "```jsonc\n";
  std::vector<std::string> found;
  for (std::size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
    at += fence.size();
    found.push_back(text.substr(at, text.find("```", at) - at));
  }
  return found;
}

TEST(Guide, HoldsNothingButJson) {
  for (const std::string& sample : samples()) {
    const engine::SourceFile source{"sample", "/", ""};
    engine::JsonValue document;
    std::vector<engine::Problem> problems;
    EXPECT_TRUE(engine::parse_json(sample[0] == '{' ? sample : "{" + sample + "}", source, document, problems))
        << problems.at(0).line() << "\n"
        << sample;
    EXPECT_TRUE(problems.empty());
  }
}

TEST(Guide, ShowsGraphsThatAreValid) {
  const test::GraphFiles files;
  std::vector<std::string> graphs;
  for (const std::string& sample : samples())
    if (sample.find("\"facegraph\": 1") != std::string::npos) graphs.push_back(sample);
  ASSERT_EQ(graphs.size(), 3u);
  files.write("graph.json", graphs[0]);
  files.write("experiment.json", graphs[1]);
  files.write("shout.json", graphs[2]);
  files.write("line.txt", "hello");
  files.write("other.txt", "hello");
  files.write("outer.json", R"({"facegraph": 1, "nodes": {
    "text": {"node": "toy.read_text", "inputs": {"file": {"file": "line.txt"}}},
    "many": {"node": "toy.repeat", "inputs": {"text": "text"}},
    "shout": {"graph": "shout.json", "inputs": {"words": "many"}, "params": {"mode": "lower"}},
    "page": {"node": "toy.write_text", "inputs": {"text": "shout.text"}}}, "outputs": {"page.txt": "page"}})");
  for (const char* const name : {"graph.json", "experiment.json", "outer.json"})
    EXPECT_EQ(files.problems(name), "") << name;
}

TEST(Guide, ShowsOptionalParametersThatWork) {
  const test::GraphFiles files;
  for (const std::string& sample : samples())
    if (sample.find("\"alternatives\"") != std::string::npos)
      files.write("graph.json", "{\"facegraph\": 1, \"outputs\": {\"page.txt\": \"page\"}, " +
                                    sample.substr(0, sample.rfind('}')) +
                                    ", \"page\": {\"node\": \"toy.write_text\", \"inputs\": {\"text\": \"words\"}}}}");
  files.write("line.txt", "hello");
  EXPECT_EQ(files.problems("graph.json", {{"spoken", "line.txt"}}), "");
  EXPECT_EQ(files.problems("graph.json", {{"spoken", "line.txt"}, {"text", "line.txt"}}), "");
}

}  // namespace
