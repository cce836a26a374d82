// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/support/graph_files.h"

namespace {

using engine::GraphReading;
using engine::ParamValue;
using engine::Setting;
using test::GraphFiles;

class Settings : public testing::Test {
 protected:
  Settings() {
    files.write("sub/shout.json", R"({"facegraph": 1,
      "inputs": {"words": "Seq<text>"},
      "params": {"mode": {"type": "choice", "choices": ["upper", "lower"], "default": "upper"}},
      "nodes": {"loud": {"node": "toy.upper", "inputs": {"text": "@words"}, "params": {"mode": "${mode}"}},
                "joined": {"node": "toy.concat", "inputs": {"texts": "loud"}}},
      "outputs": {"text": "joined"}})");
    files.write("graph.json", R"({"facegraph": 1,
      "params": {"line": {"type": "path", "default": "sub/line.txt"}, "times": {"type": "integer", "default": 3},
                 "flags": {"type": "boolean", "list": true, "default": []}},
      "nodes": {"text": {"node": "toy.read_text", "inputs": {"file": "${line}"}},
                "many": {"node": "toy.repeat", "inputs": {"text": "text"}, "params": {"times": "${times}"}},
                "pick": {"node": "seq.select", "inputs": {"sequence": "many"}, "params": {"ids": ["1"]}},
                "shout": {"graph": "sub/shout.json", "inputs": {"words": "pick"}},
                "size": {"node": "toy.length", "inputs": {"text": "text"}},
                "more": {"node": "toy.add", "inputs": {"a": "size", "b": "size"}},
                "page": {"node": "toy.write_text", "inputs": {"text": "shout"}}},
      "outputs": {"page.txt": "page"}})");
    files.write("sub/line.txt", "hello");
  }
  ParamValue param(const std::string& node, const std::string& name, const std::vector<Setting>& settings) {
    EXPECT_EQ(files.problems("graph.json", settings), "");
    const GraphReading reading = files.read("graph.json", settings);
    const auto& found = reading.graph.nodes.at(reading.graph.find_node(node));
    return found.params.at(found.info->find_param(name));
  }
  GraphFiles files;
};

TEST_F(Settings, ReplaceAParameterOfTheGraph) {
  EXPECT_EQ(param("many", "times", {}), ParamValue(std::int64_t{3}));
  EXPECT_EQ(param("many", "times", {{"times", "7"}}), ParamValue(std::int64_t{7}));
}

TEST_F(Settings, ReplaceAParameterOfANode) {
  EXPECT_EQ(param("many", "times", {{"many.times", "9"}, {"times", "7"}}), ParamValue(std::int64_t{9}));
  EXPECT_EQ(param("more", "amount", {{"more.amount", "2.5"}}), ParamValue(2.5));
  EXPECT_EQ(param("more", "amount", {{"more.amount", "2"}}), ParamValue(2.0));
}

TEST_F(Settings, ReachIntoSubgraphs) {
  EXPECT_EQ(param("shout/loud", "mode", {{"shout.mode", "lower"}}), ParamValue(std::string("lower")));
  EXPECT_EQ(param("shout/loud", "mode", {{"shout/loud.mode", "title"}}), ParamValue(std::string("title")));
  EXPECT_EQ(param("shout/joined", "separator", {{"shout/joined.separator", "="}}), ParamValue(std::string("=")));
}

TEST_F(Settings, TakeListsWithCommasOrAsJson) {
  const std::vector<std::string> ids{"1", "4-6"};
  EXPECT_EQ(param("pick", "ids", {{"pick.ids", "1,4-6"}}), ParamValue(ids));
  EXPECT_EQ(param("pick", "ids", {{"pick.ids", "[\"1\", \"4-6\"]"}}), ParamValue(ids));
  EXPECT_EQ(param("pick", "ids", {{"pick.ids", ""}}), ParamValue(std::vector<std::string>{}));
}

TEST_F(Settings, TakePathsRelativeToTheWorkingDirectory) {
  files.write("own.txt", "mine");
  ASSERT_EQ(files.problems("graph.json", {{"line", "own.txt"}}), "");
  const GraphReading reading = files.read("graph.json", {{"line", "own.txt"}});
  EXPECT_EQ(reading.graph.nodes[0].inputs[0][0].path, files.path("own.txt"));
  EXPECT_EQ(files.problems("graph.json", {{"line", "other.txt"}}),
            "command line: --set line: the file other.txt does not exist\n");
}

TEST_F(Settings, AreChecked) {
  EXPECT_EQ(files.problems("graph.json", {{"times", "x"}}),
            "command line: --set times: found the string \"x\", expected an integer\n");
  EXPECT_EQ(files.problems("graph.json", {{"times", "2000"}}),
            "command line: --set times: found the number 2000, expected an integer from 1 to 1000 (used at "
            "/nodes/many/params/times)\n");
  EXPECT_EQ(files.problems("graph.json", {{"many.times", "1.5"}}),
            "command line: --set many.times: found the number 1.5, expected an integer from 1 to 1000\n");
  // "found the number 20000000000000000, expected an integer"
  EXPECT_EQ(files.problems("graph.json", {{"times", "20000000000000000"}}),
            "command line: --set times: found the number 20000000000000000, expected an integer of at most "
            "9007199254740991 in size\n");
  EXPECT_EQ(files.problems("graph.json", {{"shout.mode", "title"}}),
            "command line: --set shout.mode: found the string \"title\", expected one of \"upper\", \"lower\"\n");
  EXPECT_EQ(files.problems("graph.json", {{"more.amount", "nan"}}),
            "command line: --set more.amount: found the string \"nan\", expected a number from -1000 to 1000\n");
  EXPECT_EQ(files.problems("graph.json", {{"line", ""}}),
            "command line: --set line: found the string \"\", expected a path\n");
}

TEST_F(Settings, OfWhatIsNotThereAreRefused) {
  EXPECT_EQ(files.problems("graph.json", {{"tims", "3"}}),
            "command line: --set tims: the graph has no parameter 'tims' (did you mean 'times'?)\n");
  EXPECT_EQ(files.problems("graph.json", {{"mani.times", "3"}}),
            "command line: --set mani.times: the graph has no node 'mani' (did you mean 'many'?)\n");
  EXPECT_EQ(files.problems("graph.json", {{"many.time", "3"}}),
            "command line: --set many.time: the node 'many' has no parameter 'time' (did you mean 'times'?)\n");
  EXPECT_EQ(files.problems("graph.json", {{"shout.moed", "upper"}}),
            "command line: --set shout.moed: the node 'shout' has no parameter 'moed'; it has 'mode'\n");
  EXPECT_EQ(files.problems("graph.json", {{"times", "3"}, {"times", "4"}}),
            "command line: --set times: it is set twice\n");
}

}  // namespace
