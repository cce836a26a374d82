// SPDX-License-Identifier: Apache-2.0
// Every graph of graphs/broken holds a seeded mistake; the .txt beside it is what a person is told, word for word.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/graph/graph.h"
#include "tests/support/toy_catalogue.h"

namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> broken_graphs() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(FACEGRAPH_SOURCE_DIR) / "graphs" / "broken"))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class BrokenGraph : public testing::TestWithParam<std::string> {};

TEST_P(BrokenGraph, IsToldWordForWord) {
  const test::ToyCatalogue catalogue;
  const std::string graph = "graphs/broken/" + GetParam() + ".json";
  const engine::GraphReading reading = engine::read_graph(graph, {}, FACEGRAPH_SOURCE_DIR, catalogue.context());
  std::string lines;
  for (const engine::Problem& problem : reading.problems) lines += problem.line() + "\n";
  EXPECT_EQ(lines, content(fs::path(FACEGRAPH_SOURCE_DIR) / "graphs" / "broken" / (GetParam() + ".txt")));
}

INSTANTIATE_TEST_SUITE_P(Graphs, BrokenGraph, testing::ValuesIn(broken_graphs()), [](const auto& test) {
  std::string name = test.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

TEST(BrokenGraphs, AreAtLeastForty) { EXPECT_GE(broken_graphs().size(), 40u); }

}  // namespace
