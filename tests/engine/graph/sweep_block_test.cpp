// SPDX-License-Identifier: Apache-2.0
// The sweep block of a graph, and settings that put another kind of node in place.
#include <gtest/gtest.h>

#include "tests/support/graph_files.h"

namespace {

class SweepBlock : public testing::Test {
 protected:
  std::string problems_of(const std::string& block, const std::vector<engine::Setting>& settings = {}) {
    files.write("line.txt", "hello");
    files.write(
        "graph.json",
        R"({"facegraph": 1, "params": {"line": {"type": "path", "default": "line.txt"}, "count": {"type": "integer", "default": 2}},
"nodes": {"text": {"node": "toy.read_text", "inputs": {"file": "${line}"}},
"many": {"node": "toy.repeat", "inputs": {"text": "text"}, "params": {"times": "${count}"}},
"loud": {"node": "toy.upper", "inputs": {"text": "many"}, "params": {"mode": "lower"}},
"all": {"node": "toy.concat", "inputs": {"texts": "loud"}},
"size": {"node": "toy.length", "inputs": {"text": "all"}},
"page": {"node": "toy.write_text", "inputs": {"text": "all"}}},
"outputs": {"page.txt": "page"},
"sweep": )" +
            block + "}");
    return files.problems("graph.json", settings);
  }
  test::GraphFiles files;
};

TEST_F(SweepBlock, IsReadAsSettings) {
  EXPECT_EQ(problems_of(R"({"vary": {"count": [1, 3], "loud.mode": ["upper", "lower"], "line": ["line.txt"],
    "all.separator": [", "]}, "metric": "size.length"})"),
            "");
  const engine::SweepSettings sweep = files.read("graph.json").graph.sweep;
  ASSERT_EQ(sweep.vary.size(), 4u);
  EXPECT_EQ(sweep.vary[0].values, (std::vector<std::string>{"1", "3"}));
  EXPECT_EQ(sweep.vary[1].name, "loud.mode");
  EXPECT_EQ(sweep.vary[2].values, std::vector<std::string>{files.path("line.txt")});
  EXPECT_EQ(sweep.vary[2].shown, std::vector<std::string>{"line.txt"});
  EXPECT_EQ(sweep.metrics, std::vector<std::string>{"size.length"});
}

TEST_F(SweepBlock, TellsItsMistakesWithTheirPlaces) {
  EXPECT_EQ(
      problems_of(R"({"vary": {
 "count": [1, "many"],
 "cuont": [1],
 "loud.mood": ["upper"],
 "loud.mode": ["loud"],
 "lout.mode": ["upper"],
 "loud.node": ["toy.uper"],
 "many.times": []},
 "metric": ["sise.length", "size.lenght", 3], "best": 1})"),
      R"(graph.json:10:15: /sweep/vary/count/1: found the string "many", expected an integer
graph.json:11:2: /sweep/vary/cuont: the graph has no parameter 'cuont'; it has 'count' and 'line'
graph.json:12:2: /sweep/vary/loud.mood: the node 'loud' has no parameter 'mood'; it has 'mode'
graph.json:13:16: /sweep/vary/loud.mode/0: found the string "loud", expected one of "upper", "lower", "title"
graph.json:14:2: /sweep/vary/lout.mode: the graph has no node 'lout' (did you mean 'loud'?)
graph.json:15:16: /sweep/vary/loud.node/0: no node is called "toy.uper" (did you mean 'toy.upper'?)
graph.json:16:16: /sweep/vary/many.times: found an empty list, expected a list of the values to try
graph.json:17:13: /sweep/metric/0: the graph has no node 'sise' (did you mean 'size'?)
graph.json:17:28: /sweep/metric/1: 'toy.length' has no output 'lenght' (did you mean 'length'?)
graph.json:17:43: /sweep/metric/2: found the number 3, expected NODE.OUTPUT
graph.json:17:47: /sweep/best: unknown key "best"; the sweep block has the keys 'vary' and 'metric'
)");
}

TEST_F(SweepBlock, TakesParametersOfEveryKindThatANodeIsToBe) {
  files.catalogue.add(test::toy_node("toy.shout", {test::toy_input("text", "text")},
                                     {test::toy_param("marks", engine::ParamKind::integer, std::int64_t{1}, 0, 9)},
                                     {test::toy_output("changed", "text")}));
  EXPECT_EQ(problems_of(R"({"vary": {"loud.node": ["toy.upper", "toy.shout"], "loud.marks": [1, 2]}})"), "");
}

TEST_F(SweepBlock, AKindThatIsSetLeavesParametersOutThatItLacksAndSaysSo) {
  files.catalogue.add(test::toy_node("toy.shout", {test::toy_input("text", "text")},
                                     {test::toy_param("marks", engine::ParamKind::integer, std::int64_t{1}, 0, 9)},
                                     {test::toy_output("changed", "text")}));
  EXPECT_EQ(problems_of("{}", {{"loud.node", "toy.shout"}, {"loud.marks", "3"}}), "");
  const engine::Graph graph = files.read("graph.json", {{"loud.node", "toy.shout"}, {"loud.marks", "3"}}).graph;
  EXPECT_EQ(graph.nodes.at(graph.find_node("loud")).info->name, "toy.shout");
  EXPECT_EQ(graph.notes,
            std::vector<std::string>{"loud: toy.shout has no parameter 'mode'; that of the graph is left out"});
  EXPECT_EQ(problems_of("{}", {{"loud.node", "toy.shot"}}),
            "command line: --set loud.node: no node is called \"toy.shot\" (did you mean 'toy.shout'?)\n");
  EXPECT_EQ(problems_of("{}", {{"lout.node", "toy.shout"}}),
            "command line: --set lout.node: the graph has no node 'lout' (did you mean 'loud'?)\n");
}

}  // namespace
