// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/support/graph_files.h"

namespace {

using test::GraphFiles;

// 'loud' is mapped over two levels.
class Overrides : public testing::Test {
 protected:
  Overrides() { files.write("line.txt", "hello"); }
  std::string problems(const std::string& overrides) {
    return files.problems_of(R"("text": {"node": "toy.read_text", "inputs": {"file": {"file": "line.txt"}}},
      "many": {"node": "toy.repeat", "inputs": {"text": "text"}},
"deep": {"node": "toy.repeat", "inputs": {"text": "many"}},  "loud": {"node": "toy.upper", "inputs": {"text": "deep"},
"overrides": {)" + overrides + R"(}},
      "page": {"node": "toy.write_text", "inputs": {"text": "loud"}})",
                             "\"page.txt\": \"page\"");
  }
  GraphFiles files;
};

TEST_F(Overrides, NameElementsAndRangesUnderOneOrEveryParent) {
  ASSERT_EQ(problems(R"("17-0023, 40": {"mode": "lower"}, "take03/17a": {"mode": "title"})"), "");
  const auto reading = files.read("graph.json");
  const auto& overrides = reading.graph.nodes.at(reading.graph.find_node("loud")).overrides;
  ASSERT_EQ(overrides.size(), 2u);
  EXPECT_EQ(overrides[0].text, "17-0023, 40");
  ASSERT_EQ(overrides[0].ranges.size(), 2u);
  EXPECT_EQ(overrides[0].ranges[0].first, "17");
  EXPECT_EQ(overrides[0].ranges[0].last, "23");
  EXPECT_TRUE(overrides[0].ranges[0].parents.empty());
  EXPECT_EQ(overrides[1].ranges[0].parents, std::vector<std::string>{"take03"});
  EXPECT_EQ(overrides[1].ranges[0].first, "17a");
  EXPECT_EQ(reading.graph.nodes.at(reading.graph.find_node("loud")).mapped_depth, 2);
}

TEST_F(Overrides, OfDifferentParentsDoNotOverlap) {
  EXPECT_EQ(
      problems(
          R"("a/1-5": {"mode": "lower"}, "b/3": {"mode": "title"}, "6": {"mode": "title"}, "name": {"mode": "lower"})"),
      "");
}

TEST_F(Overrides, OfEveryParentOverlapThoseOfOne) {
  EXPECT_EQ(problems("\"3\": {\"mode\": \"lower\"},\n\"a/1-5\": {\"mode\": \"title\"}"),
            "graph.json:5:1: /nodes/loud/overrides/a~11-5: 'a/1-5' overlaps '3' of \"3\": which value holds would be a "
            "guess\n");
  EXPECT_EQ(problems("\"name\": {\"mode\": \"lower\"},\n\"a/name\": {\"mode\": \"title\"}"),
            "graph.json:5:1: /nodes/loud/overrides/a~1name: 'a/name' overlaps 'name' of \"name\": which value holds "
            "would be a guess\n");
}

TEST_F(Overrides, ThatOverlapEverywhereAreToldOnce) {
  EXPECT_EQ(
      problems("\"1-9\": {\"mode\": \"lower\"}, \"a/10\": {\"mode\": \"title\"}, \"b/11\": {\"mode\": "
               "\"title\"},\n\"5,7\": {\"mode\": \"title\"}"),
      "graph.json:5:1: /nodes/loud/overrides/5,7: '5' overlaps '1-9' of \"1-9\": which value holds would be a guess\n"
      "graph.json:5:1: /nodes/loud/overrides/5,7: '7' overlaps '1-9' of \"1-9\": which value holds would be a guess\n");
  EXPECT_EQ(problems("\"1-9,5\": {\"mode\": \"lower\"}"),
            "graph.json:4:15: /nodes/loud/overrides/1-9,5: '5' overlaps '1-9' of the same key: which value holds would "
            "be a guess\n");
}

TEST_F(Overrides, CompareLongIdsByValue) {
  EXPECT_EQ(problems(R"("9-99999999999999999999": {"mode": "lower"}, "100000000000000000000": {"mode": "title"})"), "");
}

TEST_F(Overrides, AreChecked) {
  EXPECT_EQ(problems(R"("": {"mode": "lower"})"),
            "graph.json:4:15: /nodes/loud/overrides/: '' is no element id or range (ids are made of "
            "letters, digits, '_', '-' and '.', and 3-5 is a range)\n");
  EXPECT_EQ(problems(R"("a/b/1": {"mode": "lower"})"),
            "graph.json:4:15: /nodes/loud/overrides/a~1b~11: 'a/b/1' has 3 levels, but 'loud' is mapped over 2\n");
  EXPECT_EQ(problems(R"("1": {})"),
            "graph.json:4:20: /nodes/loud/overrides/1: found an empty object, expected an object of parameters\n");
}

}  // namespace
