// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/support/graph_files.h"

namespace {

using engine::GraphReading;
using engine::ParamValue;
using test::GraphFiles;

constexpr const char* base = R"({
  "facegraph": 1,
  "params": {"line": {"type": "path", "default": "line.txt"}, "times": {"type": "integer", "default": 3}},
  "nodes": {
    "text": {"node": "toy.read_text", "inputs": {"file": "${line}"}},
    "many": {"node": "toy.repeat", "inputs": {"text": "text"}, "params": {"times": "${times}"}},
    "page": {"node": "toy.write_text", "inputs": {"text": "text"}},
    "pages": {"node": "toy.write_text", "inputs": {"text": "many"}}
  },
  "outputs": {"page.txt": "page", "pages.txt": "pages"}
})";

class Extends : public testing::Test {
 protected:
  Extends() {
    files.write("base/graph.json", base);
    files.write("base/line.txt", "hello");
  }
  GraphFiles files;
};

TEST_F(Extends, ChangesWhatItNamesAndKeepsTheRest) {
  files.write("mine/graph.json", R"({"facegraph": 1, "extends": "../base/graph.json",
    "params": {"times": {"default": 5}}, "outputs": {"pages.txt": null}})");
  ASSERT_EQ(files.problems("mine/graph.json"), "");
  const GraphReading reading = files.read("mine/graph.json");
  EXPECT_EQ(reading.graph.nodes[reading.graph.find_node("many")].params[0], ParamValue(std::int64_t{5}));
  ASSERT_EQ(reading.graph.outputs.size(), 1u);
  EXPECT_EQ(reading.graph.outputs[0].name, "page.txt");
}

TEST_F(Extends, KeepsPathsRelativeToTheFileTheyWereWrittenIn) {
  files.write("mine/graph.json", R"({"extends": "../base/graph.json"})");
  ASSERT_EQ(files.problems("mine/graph.json"), "");
  GraphReading reading = files.read("mine/graph.json");
  EXPECT_EQ(reading.graph.nodes[0].inputs[0][0].path, files.path("base/line.txt"));
  EXPECT_EQ(reading.graph.nodes[0].inputs[0][0].shown_path, "base/line.txt");

  files.write("mine/other.json", R"({"extends": "graph.json", "params": {"line": {"default": "own.txt"}}})");
  files.write("mine/own.txt", "mine");
  ASSERT_EQ(files.problems("mine/other.json"), "");
  reading = files.read("mine/other.json");
  EXPECT_EQ(reading.graph.nodes[0].inputs[0][0].path, files.path("mine/own.txt"));
}

TEST_F(Extends, TellsMistakesWhereTheyAreWritten) {
  files.write("a.json", R"({"extends": "base/graph.json",
    "nodes": {"many": {"params": {"times": 0}}}})");
  files.write("b.json", R"({"extends": "a.json",
    "nodes": {"page": {"inputs": {"text": "many[x y]"}}}})");
  EXPECT_EQ(files.problems("b.json"),
            "a.json:2:44: /nodes/many/params/times: found the number 0, expected an integer from 1 to 1000\n"
            "b.json:2:43: /nodes/page/inputs/text: 'many[x y]' is no reference: 'x y' is no element id (ids are made "
            "of letters, "
            "digits, '_', '-' and '.', and 3-5 is a range)\n");
}

TEST_F(Extends, TellsAMissingFileWhereItsPathIsWritten) {
  files.write("a.json", R"({"extends": "base/graph.json", "params": {"line": {"default": "lime.txt"}}})");
  EXPECT_EQ(files.problems("a.json"), "a.json:1:63: /params/line/default: the file lime.txt does not exist\n");
}

TEST_F(Extends, ReplacesAnObjectByAValueAndAValueByAnObject) {
  files.write("a.json",
              R"({"extends": "base/graph.json", "nodes": {"text": {"inputs": {"file": {"file": "own.txt"}}}}})");
  files.write("own.txt", "mine");
  ASSERT_EQ(files.problems("a.json"), "");
  EXPECT_EQ(files.read("a.json").graph.nodes[0].inputs[0][0].path, files.path("own.txt"));
}

TEST_F(Extends, IsRefusedInARing) {
  files.write("a.json", R"({"extends": "b.json"})");
  files.write("b.json", R"({"extends": "c.json"})");
  files.write("c.json", R"({"extends": "b.json"})");
  EXPECT_EQ(files.problems("a.json"),
            "c.json:1:13: /extends: a file cannot extend itself: b.json extends c.json extends b.json\n");
}

TEST_F(Extends, IsTheVersionOfTheBaseUnlessTheFileSaysOtherwise) {
  files.write("a.json", R"({"facegraph": 3, "extends": "base/graph.json"})");
  EXPECT_EQ(
      files.problems("a.json"),
      "a.json:1:15: /facegraph: found the number 3, expected 1: the version of graph files that this program reads\n");
}

}  // namespace
