// SPDX-License-Identifier: Apache-2.0
// What is checked across nodes: the engine's own nodes, types, depths, order and size.
#include <gtest/gtest.h>

#include "tests/support/graph_files.h"

namespace {

using engine::Graph;
using test::GraphFiles;

class Validation : public testing::Test {
 protected:
  Validation() {
    files.write("line.txt", "hello");
    files.catalogue.add(
        test::toy_node("toy.is_long", {test::toy_input("text", "text")}, {}, {test::toy_output("long", "flag")}));
  }
  // The given nodes after a text, a sequence of texts and a sequence of sequences; the nodes start in line 4.
  std::string problems(const std::string& nodes) {
    return files.problems_of(R"("text": {"node": "toy.read_text", "inputs": {"file": {"file": "line.txt"}}},
"many": {"node": "toy.repeat", "inputs": {"text": "text"}}, "deep": {"node": "toy.repeat", "inputs": {"text": "many"}},
"page": {"node": "toy.write_text", "inputs": {"text": "text"}},
)" + nodes,
                             "\"page.txt\": \"page\"");
  }
  engine::GraphNode node(const std::string& id) {
    const Graph graph = files.read("graph.json").graph;
    return graph.nodes.at(graph.find_node(id));
  }
  GraphFiles files;
};

TEST_F(Validation, EnginesOwnNodesTakeTheTypeOfTheirInput) {
  ASSERT_EQ(problems(R"("sizes": {"node": "toy.length", "inputs": {"text": "deep"}},
    "half": {"node": "seq.every", "inputs": {"sequence": "sizes"}},
    "flat": {"node": "seq.flatten", "inputs": {"sequences": "sizes"}},
    "ids": {"node": "seq.ids", "inputs": {"sequence": "flat"}},
    "both": {"node": "seq.merge", "inputs": {"sequences": ["flat", "half[1]"]}},
    "best": {"node": "first", "inputs": {"alternatives": ["sizes", "half"]}},
    "one": {"node": "first", "inputs": {"alternatives": "sizes"}})"),
            "");
  EXPECT_EQ(node("half").output_type[0], "number");
  EXPECT_EQ(node("half").mapped_depth, 1);
  EXPECT_EQ(node("half").output_depth[0], 2);
  EXPECT_EQ(node("flat").mapped_depth, 0);
  EXPECT_EQ(node("flat").output_depth[0], 1);
  EXPECT_EQ(node("ids").output_type[0], "text");
  EXPECT_EQ(node("both").mapped_depth, 0);
  EXPECT_EQ(node("best").mapped_depth, 0);
  EXPECT_EQ(node("best").output_depth[0], 2);
  EXPECT_EQ(node("one").output_type[0], "number");
}

TEST_F(Validation, AlternativesAgreeInTypeAndDepth) {
  EXPECT_EQ(problems(R"("sizes": {"node": "toy.length", "inputs": {"text": "many"}},
"best": {"node": "first", "inputs": {"alternatives": ["many", "sizes",
"deep"]}})"),
            "graph.json:5:63: /nodes/best/inputs/alternatives/1: the input 'alternatives' of 'first' takes "
            "alternatives of one type: found 'number' after 'text'\n"
            "graph.json:6:1: /nodes/best/inputs/alternatives/2: the input 'alternatives' of 'first' takes alternatives "
            "of one depth: found a sequence of depth 2 after a sequence\n");
}

TEST_F(Validation, FlagsAreThoseOfTheirOwnSequence) {
  EXPECT_EQ(problems(R"("long": {"node": "toy.is_long", "inputs": {"text": "deep"}},
    "kept": {"node": "seq.where", "inputs": {"sequence": "deep", "flags": "long"}})"),
            "");
  EXPECT_EQ(node("kept").mapped_depth, 1);
  EXPECT_EQ(problems(R"("long": {"node": "toy.is_long", "inputs": {"text": "many"}},
"kept": {"node": "seq.where", "inputs": {"sequence": "deep", "flags": "long"}})"),
            "graph.json:5:71: /nodes/kept/inputs/flags: the input 'flags' of 'seq.where' takes one flag for every "
            "element of the sequence: "
            "found a sequence for a sequence of depth 2\n");
}

TEST_F(Validation, MapsOverTheDeepestInputAndBroadcastsTheOthers) {
  ASSERT_EQ(problems(
                R"("sizes": {"node": "toy.length", "inputs": {"text": "deep"}},
    "size": {"node": "toy.length", "inputs": {"text": "text"}},
    "sum": {"node": "toy.add", "inputs": {"a": "size", "b": "sizes"}},
    "total": {"node": "toy.running_sum", "inputs": {"value": "sum"}},
    "mean": {"node": "toy.window_mean", "inputs": {"values": "total[3]"}})"),
            "");
  EXPECT_EQ(node("sum").mapped_depth, 2);
  EXPECT_EQ(node("sum").input_depth, (std::vector<int>{0, 2}));
  EXPECT_EQ(node("total").output_depth[0], 2);
  EXPECT_EQ(node("mean").mapped_depth, 1);
  EXPECT_EQ(node("mean").input_depth[0], 1);
}

TEST_F(Validation, TellsOneMistakeOnce) {
  EXPECT_EQ(problems(R"("loud": {"node": "toy.upper", "inputs": {"text": "mani"}},
"all": {"node": "toy.concat", "inputs": {"texts": "loud"}},
"sizes": {"node": "toy.length", "inputs": {"text": "loud"}},
"total": {"node": "toy.running_sum", "inputs": {"value": "sizes"}})"),
            "graph.json:4:50: /nodes/loud/inputs/text: the graph has no node 'mani' (did you mean 'many'?)\n");
}

TEST_F(Validation, FollowsTypesBeyondAMistake) {
  EXPECT_EQ(problems(R"("loud": {"node": "toy.upper", "inputs": {"text": "mani"}},
"sum": {"node": "toy.add", "inputs": {"a": "loud", "b": "loud.change"}})"),
            "graph.json:4:50: /nodes/loud/inputs/text: the graph has no node 'mani' (did you mean 'many'?)\n"
            "graph.json:5:44: /nodes/sum/inputs/a: the input 'a' of 'toy.add' takes 'number', found 'text'\n"
            "graph.json:5:57: /nodes/sum/inputs/b: 'loud' has no output 'change' (did you mean 'changed'?)\n");
}

TEST_F(Validation, NamesEveryRingOnce) {
  EXPECT_EQ(problems(R"("a": {"node": "toy.upper", "inputs": {"text": "b"}},
"b": {"node": "toy.upper", "inputs": {"text": "a"}},
"c": {"node": "toy.upper", "inputs": {"text": "c"}},
"d": {"node": "toy.upper", "inputs": {"text": "a"}})"),
            "graph.json:4:47: /nodes/a/inputs/text: the nodes need each other in a ring: a needs b needs a\n"
            "graph.json:6:47: /nodes/c/inputs/text: the nodes need each other in a ring: c needs c\n");
}

TEST_F(Validation, PutsProducersBeforeConsumersInLongChains) {
  std::string nodes;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i)
    nodes += (i == 0 ? "" : ",\n") + ("\"n" + std::to_string(i)) + R"(": {"node": "toy.upper", "inputs": {"text": ")" +
             (i + 1 == count ? std::string("many") : "n" + std::to_string(i + 1)) + "\"}}";
  ASSERT_EQ(problems(nodes), "");
  const Graph graph = files.read("graph.json").graph;
  ASSERT_EQ(graph.nodes.size(), static_cast<std::size_t>(count) + 4);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    for (const auto& sources : graph.nodes[i].inputs)
      for (const auto& source : sources) EXPECT_LT(source.node, static_cast<int>(i));  // -1 of a file
}

TEST_F(Validation, RefusesGraphsThatMultiply) {
  files.write("g0.json", R"({"facegraph": 1, "inputs": {"x": "text"}, "nodes": {}, "outputs": {"x": "@x"}})");
  for (int i = 1; i <= 30; ++i) {
    const std::string inner = "{\"graph\": \"g" + std::to_string(i - 1) + ".json\", \"inputs\": {\"x\": ";
    files.write("g" + std::to_string(i) + ".json",
                "{\"facegraph\": 1, \"inputs\": {\"x\": \"text\"}, \"nodes\": {\"a\": " + inner +
                    "\"@x\"}}, \"b\": " + inner + "\"a\"}}}, \"outputs\": {\"x\": \"b\"}}");
  }
  const std::string found = problems(R"("bomb": {"graph": "g30.json", "inputs": {"x": "text"}})");
  EXPECT_NE(found.find("the graph has more than 100000 nodes\n"), std::string::npos) << found.substr(0, 300);
}

TEST_F(Validation, SaysWhatIsNoGraphFile) {
  EXPECT_EQ(files.problems("nothing.json"), "nothing.json: does not exist\n");
  EXPECT_EQ(files.problems("."), ".: is a folder, expected a graph file\n");
  files.write("empty.json", " \n");
  EXPECT_EQ(files.problems("empty.json"), "empty.json: is empty, expected a graph file\n");
  files.write("picture.json", std::string("\x89PNG\r\n\x1a\n\0\0", 10));
  EXPECT_EQ(files.problems("picture.json"), "picture.json:1:1: not valid JSON: invalid literal \"\x89PNG\"\n");
}

TEST_F(Validation, RefusesOutputNamesThatLeaveTheFolderOrConfuseDisks) {
  for (const char* const name :
       {"../a.txt", "a/b.txt", "a\\\\b.txt", "a", ".txt", "a.", "..a.txt", "-a.txt", "a:b.txt", "", "a.txt "}) {
    const std::string found = files.problems_of(R"("page": {"node": "toy.write_text", "inputs": {"text": "text"}},
      "text": {"node": "toy.read_text", "inputs": {"file": {"file": "line.txt"}}})",
                                                "\"" + std::string(name) + "\": \"page\"");
    EXPECT_NE(found.find("is no name of an output: "), std::string::npos) << name << " was taken: " << found;
  }
}

}  // namespace
