// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/support/graph_files.h"

namespace {

using engine::Graph;
using engine::GraphReading;
using engine::ParamValue;
using test::GraphFiles;

constexpr const char* shout = R"({"facegraph": 1,
  "inputs": {"words": "Seq<text>"},
  "params": {"mode": {"type": "choice", "choices": ["upper", "lower"], "default": "upper"}},
  "nodes": {
    "loud": {"node": "toy.upper", "inputs": {"text": "@words"}, "params": {"mode": "${mode}"}},
    "joined": {"node": "toy.concat", "inputs": {"texts": "loud"}}
  },
  "outputs": {"text": "joined", "words": "loud"}
})";

class Subgraph : public testing::Test {
 protected:
  Subgraph() {
    files.write("shout.json", shout);
    files.write("line.txt", "hello");
  }
  std::string problems(const std::string& nodes, const std::string& output = "page") {
    return files.problems_of(R"("text": {"node": "toy.read_text", "inputs": {"file": {"file": "line.txt"}}},
      "many": {"node": "toy.repeat", "inputs": {"text": "text"}},
      )" + nodes,
                             "\"page.txt\": \"" + output + "\"");
  }
  Graph graph() { return files.read("graph.json").graph; }
  GraphFiles files;
};

TEST_F(Subgraph, BecomesNodesWithItsNameBeforeThem) {
  ASSERT_EQ(problems(R"("a": {"graph": "shout.json", "inputs": {"words": "many"}, "params": {"mode": "lower"}},
                        "page": {"node": "toy.write_text", "inputs": {"text": "a.text"}})"),
            "");
  const Graph read = graph();
  const auto& loud = read.nodes.at(read.find_node("a/loud"));
  EXPECT_EQ(loud.inputs[0][0].node, read.find_node("many"));
  EXPECT_EQ(loud.params[0], ParamValue(std::string("lower")));
  EXPECT_EQ(loud.mapped_depth, 1);
  EXPECT_EQ(read.nodes.at(read.find_node("page")).inputs[0][0].node, read.find_node("a/joined"));
}

TEST_F(Subgraph, IsMappedWhenItsInputIsADeeperSequence) {
  ASSERT_EQ(problems(R"("deep": {"node": "toy.repeat", "inputs": {"text": "many"}},
                        "a": {"graph": "shout.json", "inputs": {"words": "deep"}},
                        "page": {"node": "toy.write_text", "inputs": {"text": "a.text[take1]"}})"),
            "");
  const Graph read = graph();
  EXPECT_EQ(read.nodes.at(read.find_node("a/loud")).mapped_depth, 2);
  EXPECT_EQ(read.nodes.at(read.find_node("a/joined")).mapped_depth, 1);
  EXPECT_EQ(read.nodes.at(read.find_node("page")).mapped_depth, 0);
  EXPECT_EQ(read.nodes.at(read.find_node("page")).inputs[0][0].element, std::vector<std::string>{"take1"});
}

TEST_F(Subgraph, NestsAndJoinsElementSelections) {
  files.write("inner/pick.json", R"({"facegraph": 1, "inputs": {"deep": "Seq<Seq<text>>"},
    "nodes": {"loud": {"node": "toy.upper", "inputs": {"text": "@deep[007]"}}},
    "outputs": {"one": "loud[a]", "raw": "@deep[3]"}})");
  files.write("outer.json", R"({"facegraph": 1, "inputs": {"deep": "Seq<Seq<text>>"},
    "nodes": {"pick": {"graph": "inner/pick.json", "inputs": {"deep": "@deep"}}},
    "outputs": {"one": "pick.one", "raw": "pick.raw[b]"}})");
  ASSERT_EQ(problems(R"("deep": {"node": "toy.repeat", "inputs": {"text": "many"}},
                        "a": {"graph": "outer.json", "inputs": {"deep": "deep"}},
                        "size": {"node": "toy.length", "inputs": {"text": "a.one"}},
                        "page": {"node": "toy.write_text", "inputs": {"text": "a.raw"}})"),
            "");
  const Graph read = graph();
  const auto& loud = read.nodes.at(read.find_node("a/pick/loud"));
  EXPECT_EQ(loud.inputs[0][0].element, std::vector<std::string>{"7"});
  EXPECT_EQ(loud.mapped_depth, 1);
  EXPECT_EQ(read.nodes.at(read.find_node("size")).inputs[0][0].element, std::vector<std::string>{"a"});
  const auto& page = read.nodes.at(read.find_node("page"));
  EXPECT_EQ(page.inputs[0][0].node, read.find_node("deep"));
  EXPECT_EQ(page.inputs[0][0].element, (std::vector<std::string>{"3", "b"}));
}

TEST_F(Subgraph, TakesPathsFromTheGraphAroundIt) {
  files.write("read.json",
              R"({"facegraph": 1, "params": {"file": {"type": "path"}, "times": {"type": "integer", "default": 2}},
    "nodes": {"text": {"node": "toy.read_text", "inputs": {"file": "${file}"}},
              "many": {"node": "toy.repeat", "inputs": {"text": "text"}, "params": {"times": "${times}"}}},
    "outputs": {"text": "text", "many": "many"}})");
  files.write("deep/graph.json", R"({"facegraph": 1,
    "params": {"line": {"type": "path", "default": "own.txt"}, "n": {"type": "integer", "default": 9}},
    "nodes": {"a": {"graph": "../read.json", "params": {"file": "${line}", "times": "${n}"}},
              "b": {"graph": "../read.json", "params": {"file": "b.txt"}},
              "both": {"node": "seq.merge", "inputs": {"sequences": ["a.many", "b.many"]}},
              "page": {"node": "toy.write_text", "inputs": {"text": "both"}}},
    "outputs": {"page.txt": "page"}})");
  EXPECT_EQ(files.problems("deep/graph.json"),
            "deep/graph.json:2:52: /params/line/default: the file deep/own.txt does not exist\n"
            "deep/graph.json:4:65: /nodes/b/params/file: the file deep/b.txt does not exist\n");
  const Graph read = files.read("deep/graph.json").graph;
  EXPECT_EQ(read.nodes.at(read.find_node("a/many")).params[0], ParamValue(std::int64_t{9}));
  EXPECT_EQ(read.nodes.at(read.find_node("b/many")).params[0], ParamValue(std::int64_t{2}));
}

TEST_F(Subgraph, TellsWhatItsParametersLack) {
  files.write("read.json", R"({"facegraph": 1, "params": {"file": {"type": "path"}},
    "nodes": {"text": {"node": "toy.read_text", "inputs": {"file": "${file}"}}}, "outputs": {"text": "text"}})");
  EXPECT_EQ(problems(R"("a": {"graph": "read.json"},
"page": {"node": "toy.write_text", "inputs": {"text": "a"}})"),
            "graph.json:3:7: /nodes/a: the parameter 'file' of read.json needs a value\n");
  EXPECT_EQ(problems(R"("a": {"graph": "read.json", "params": {"file": "line.txt", "fil": 1}},
"page": {"node": "toy.write_text", "inputs": {"text": "a"}})"),
            "graph.json:3:66: /nodes/a/params/fil: read.json has no parameter \"fil\" (did you mean 'file'?)\n");
}

TEST_F(Subgraph, ThatReturnsItsOwnInputIsNoRing) {
  files.write("same.json", R"({"facegraph": 1, "inputs": {"x": "text"}, "nodes": {}, "outputs": {"x": "@x"}})");
  EXPECT_EQ(problems(R"("a": {"graph": "same.json", "inputs": {"x": "text"}},
                        "page": {"node": "toy.write_text", "inputs": {"text": "a.x"}})"),
            "");
  EXPECT_EQ(problems(R"("a": {"graph": "same.json", "inputs": {"x": "a.x"}},
"page": {"node": "toy.write_text", "inputs": {"text": "a.x"}})"),
            "graph.json:3:51: /nodes/a/inputs/x: the reference leads back to itself\n");
}

TEST_F(Subgraph, InARingWithTheGraphAroundItIsRefused) {
  EXPECT_EQ(problems(R"("a": {"graph": "shout.json", "inputs": {"words": "b"}},
"b": {"node": "toy.repeat", "inputs": {"text": "a.text"}},
"page": {"node": "toy.write_text", "inputs": {"text": "text"}})"),
            "shout.json:5:54: /nodes/loud/inputs/text: the nodes need each other in a ring: a/loud needs b needs "
            "a/joined needs a/loud\n");
}

TEST_F(Subgraph, WithAMistakeIsToldOnce) {
  files.write("bad.json", "{\"facegraph\": 1, \"nodes\": {}");
  EXPECT_EQ(problems(R"("a": {"graph": "bad.json", "inputs": {"x": "text"}}, "b": {"graph": "bad.json"},
                        "page": {"node": "toy.write_text", "inputs": {"text": "a.x"}})"),
            "bad.json:1:29: not valid JSON: unexpected end of input; expected '}' or a comma\n");
}

TEST_F(Subgraph, MayHoldFileOutputsThatOnlyItsOwnRunWrites) {
  files.write("both.json", R"({"facegraph": 1, "params": {"file": {"type": "path"}},
    "nodes": {"text": {"node": "toy.read_text", "inputs": {"file": "${file}"}},
              "page": {"node": "toy.write_text", "inputs": {"text": "text"}}},
    "outputs": {"page.txt": "page", "text": "text"}})");
  EXPECT_EQ(problems(R"("a": {"graph": "both.json", "params": {"file": "line.txt"}},
                        "page": {"node": "toy.write_text", "inputs": {"text": "a"}})"),
            "");
  EXPECT_EQ(files.problems("both.json", {{"file", "line.txt"}}),
            "both.json:4:37: /outputs/text: \"text\" is no name of an output: it has no suffix, such as \"text.txt\"\n"
            "both.json:4:45: /outputs/text: the output \"text\" is of type 'text', expected 'file': let a node export "
            "it first\n");
}

}  // namespace
