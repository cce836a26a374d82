// SPDX-License-Identifier: Apache-2.0
// Optional parameters: what is absent, and what stays.
#include <gtest/gtest.h>

#include "tests/support/graph_files.h"

namespace {

using engine::Graph;
using engine::ParamValue;
using engine::Setting;
using test::GraphFiles;

class Optional : public testing::Test {
 protected:
  Optional() {
    files.catalogue.add(test::toy_node("toy.label",
                                       {test::toy_input("text", "text"), test::toy_input("label", "text", 0, true)}, {},
                                       {test::toy_output("text", "text")}));
    files.write("a.txt", "a");
    files.write("b.txt", "b");
    files.write("graph.json", R"({"facegraph": 1,
      "params": {"a": {"type": "path", "optional": true}, "b": {"type": "path", "optional": true},
                 "times": {"type": "integer", "optional": true}},
      "nodes": {
        "from_a": {"node": "toy.read_text", "inputs": {"file": "${a}"}},
        "loud_a": {"node": "toy.upper", "inputs": {"text": "from_a"}},
        "from_b": {"node": "toy.read_text", "inputs": {"file": "${b}"}},
        "best": {"node": "first", "inputs": {"alternatives": ["loud_a", "from_b"]}},
        "labelled": {"node": "toy.label", "inputs": {"text": "best", "label": "from_b"}},
        "many": {"node": "toy.repeat", "inputs": {"text": "best"}, "params": {"times": "${times}"}},
        "page": {"node": "toy.write_text", "inputs": {"text": "labelled"}},
        "page_a": {"node": "toy.write_text", "inputs": {"text": "loud_a"}}},
      "outputs": {"page.txt": "page", "a.txt": "page_a"}})");
  }
  Graph graph(const std::vector<Setting>& settings) {
    EXPECT_EQ(files.problems("graph.json", settings), "");
    return files.read("graph.json", settings).graph;
  }
  static std::string ids(const Graph& graph) {
    std::string text;
    for (const auto& node : graph.nodes) text += node.id + " ";
    return text;
  }
  GraphFiles files;
};

TEST_F(Optional, NodesWithoutARequiredInputAreAbsentAndSoIsWhatNeedsThem) {
  const Graph read = graph({{"b", "b.txt"}});
  EXPECT_EQ(ids(read), "from_b best labelled many page ");
  ASSERT_EQ(read.outputs.size(), 1u);
  EXPECT_EQ(read.outputs[0].name, "page.txt");
}

TEST_F(Optional, InputsKeepOnlyTheAlternativesThatArePresent) {
  Graph read = graph({{"b", "b.txt"}});
  EXPECT_EQ(read.nodes[read.find_node("best")].inputs[0].size(), 1u);
  read = graph({{"a", "a.txt"}, {"b", "b.txt"}});
  EXPECT_EQ(read.nodes[read.find_node("best")].inputs[0].size(), 2u);
  EXPECT_EQ(read.outputs.size(), 2u);
}

TEST_F(Optional, OptionalInputsOfAbsentNodesAreUnconnected) {
  const Graph read = graph({{"a", "a.txt"}});
  EXPECT_EQ(ids(read), "from_a loud_a best labelled many page page_a ");
  EXPECT_TRUE(read.nodes[read.find_node("labelled")].inputs[1].empty());
}

TEST_F(Optional, UnsetValuesLeaveTheNodesOwnDefault) {
  EXPECT_EQ(graph({{"a", "a.txt"}}).nodes[4].params[0], ParamValue(std::int64_t{2}));
  EXPECT_EQ(graph({{"a", "a.txt"}, {"times", "5"}}).nodes[4].params[0], ParamValue(std::int64_t{5}));
}

TEST_F(Optional, AGraphWithoutAnyOutputSaysWhatToSet) {
  EXPECT_EQ(files.problems("graph.json"),
            "graph.json:13:19: /outputs/page.txt: no output is left, since optional parameters are unset: --set a=PATH "
            "or --set b=PATH\n");
}

TEST_F(Optional, MistakesInAbsentNodesAreToldAllTheSame) {
  files.write("wrong.json", R"({"extends": "graph.json", "nodes": {"loud_a": {"params": {"mode": "up"}},
    "sizes": {"node": "toy.length", "inputs": {"text": "from_a[3]"}}}})");
  EXPECT_EQ(files.problems("wrong.json", {{"b", "b.txt"}}),
            "wrong.json:1:67: /nodes/loud_a/params/mode: found the string \"up\", expected one of \"upper\", "
            "\"lower\", \"title\"\n"
            "wrong.json:2:56: /nodes/sizes/inputs/text: the reference selects an element 1 level deep, but 'from_a' is "
            "a single value\n");
}

TEST_F(Optional, DepthsAreThoseOfWhatIsPresent) {
  files.write("deep.json", R"({"extends": "graph.json", "nodes": {
    "loud_a": {"inputs": {"text": "many_a"}}, "many_a": {"node": "toy.repeat", "inputs": {"text": "from_a"}},
    "best": {"inputs": {"alternatives": ["from_b", "from_b"]}},
    "labelled": {"inputs": {"label": "loud_a"}}}, "outputs": {"a.txt": null}})");
  Graph read = files.read("deep.json", {{"b", "b.txt"}}).graph;
  ASSERT_EQ(files.problems("deep.json", {{"b", "b.txt"}}), "");
  EXPECT_EQ(read.nodes[read.find_node("labelled")].mapped_depth, 0);
  ASSERT_EQ(files.problems("deep.json", {{"a", "a.txt"}, {"b", "b.txt"}}), "");
  read = files.read("deep.json", {{"a", "a.txt"}, {"b", "b.txt"}}).graph;
  EXPECT_EQ(read.nodes[read.find_node("labelled")].mapped_depth, 1);
}

TEST_F(Optional, FilesOfWhatNoOutputNeedsNeedNotExist) {
  files.write("graph.json", R"({"facegraph": 1,
    "nodes": {"used": {"node": "toy.read_text", "inputs": {"file": {"file": "a.txt"}}},
              "spare": {"node": "toy.read_text", "inputs": {"file": {"file": "nowhere.txt"}}},
              "page": {"node": "toy.write_text", "inputs": {"text": "used"}}},
    "outputs": {"page.txt": "page"}})");
  EXPECT_EQ(files.problems("graph.json"), "");
}

TEST_F(Optional, PassesThroughSubgraphs) {
  files.write("part.json", R"({"facegraph": 1, "inputs": {"x": "text"},
    "params": {"file": {"type": "path", "optional": true}},
    "nodes": {"own": {"node": "toy.read_text", "inputs": {"file": "${file}"}},
              "both": {"node": "toy.label", "inputs": {"text": "@x", "label": "own"}}},
    "outputs": {"both": "both", "own": "own"}})");
  files.write("outer.json", R"({"facegraph": 1,
    "params": {"line": {"type": "path", "optional": true}, "a": {"type": "path", "default": "a.txt"}},
    "nodes": {"text": {"node": "toy.read_text", "inputs": {"file": "${a}"}},
              "part": {"graph": "part.json", "inputs": {"x": "text"}, "params": {"file": "${line}"}},
              "page": {"node": "toy.write_text", "inputs": {"text": "part.both"}},
              "own": {"node": "toy.write_text", "inputs": {"text": "part.own"}}},
    "outputs": {"page.txt": "page", "own.txt": "own"}})");
  ASSERT_EQ(files.problems("outer.json"), "");
  EXPECT_EQ(ids(files.read("outer.json").graph), "text part/both page ");
  files.write("only.json", R"({"extends": "outer.json", "outputs": {"page.txt": null}})");
  EXPECT_EQ(
      files.problems("only.json"),
      "outer.json:7:37: /outputs/own.txt: no output is left, since optional parameters are unset: --set line=PATH\n");
  EXPECT_EQ(files.problems("only.json", {{"part.file", "b.txt"}}), "");
}

}  // namespace
