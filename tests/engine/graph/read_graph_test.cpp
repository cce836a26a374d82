// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/support/graph_files.h"

namespace {

using engine::Graph;
using engine::GraphReading;
using engine::ParamValue;
using engine::Source;
using test::GraphFiles;

constexpr const char* frames = R"({
  "facegraph": 1,
  "params": {
    "folder": {"type": "path", "default": "in"},  // texts
    "amount": {"type": "real", "default": 3}
  },
  "nodes": {
    "page": {"node": "toy.write_text", "inputs": {"text": "joined"}},
    "files": {"node": "files.list", "inputs": {"folder": "${folder}"}, "params": {"pattern": "*.txt"}},
    "text": {"node": "toy.read_text", "inputs": {"file": "files"}},
    "loud": {"node": "toy.upper", "inputs": {"text": "text"}, "overrides": {"17-23,40": {"mode": "lower"}}},
    "joined": {"node": "toy.concat", "inputs": {"texts": "loud"}, "params": {"separator": ", "}},
    "length": {"node": "toy.length", "inputs": {"text": "text.text[0017]"}},
    "more": {"node": "toy.add", "inputs": {"a": "length", "b": "length"}, "params": {"amount": "${amount}"}}
  },
  "outputs": {"page.txt": "page"},
  "run": {"memory": "8GB", "timeout_s": 600},
  "layout": {"page": [1, 2]}
})";

TEST(ReadGraph, ReadsNodesInputsParamsAndOutputs) {
  GraphFiles files;
  files.write("graph.json", frames);
  files.write("in/1.txt", "one");
  const GraphReading reading = files.read("graph.json");
  ASSERT_EQ(files.problems("graph.json"), "");
  const Graph& graph = reading.graph;
  EXPECT_EQ(graph.path, files.path("graph.json"));
  std::string order;
  for (const auto& node : graph.nodes) order += node.id + (node.needed ? "! " : " ");
  EXPECT_EQ(order, "files! text! loud! joined! page! length more ");

  const auto& list = graph.nodes[graph.find_node("files")];
  ASSERT_EQ(list.inputs[0].size(), 1u);
  EXPECT_EQ(list.inputs[0][0].kind, Source::Kind::file);
  EXPECT_EQ(list.inputs[0][0].path, files.path("in"));
  EXPECT_EQ(list.inputs[0][0].shown_path, "in");
  EXPECT_EQ(list.params[0], ParamValue(std::string("*.txt")));
  EXPECT_EQ(list.output_depth[0], 1);

  const auto& loud = graph.nodes[graph.find_node("loud")];
  EXPECT_EQ(loud.mapped_depth, 1);
  EXPECT_EQ(loud.input_depth[0], 1);
  EXPECT_EQ(loud.output_type[0], "text");
  ASSERT_EQ(loud.overrides.size(), 1u);
  EXPECT_EQ(loud.overrides[0].ranges[0].first, "17");
  EXPECT_EQ(loud.overrides[0].ranges[0].last, "23");
  EXPECT_EQ(loud.overrides[0].ranges[1].first, "40");
  EXPECT_EQ(loud.overrides[0].params[0].second, ParamValue(std::string("lower")));

  EXPECT_EQ(graph.nodes[graph.find_node("joined")].mapped_depth, 0);
  EXPECT_EQ(graph.nodes[graph.find_node("joined")].input_depth[0], 1);
  const auto& length = graph.nodes[graph.find_node("length")];
  EXPECT_EQ(length.inputs[0][0].element, std::vector<std::string>{"17"});
  EXPECT_EQ(length.input_depth[0], 0);
  EXPECT_EQ(length.mapped_depth, 0);
  EXPECT_EQ(graph.nodes[graph.find_node("more")].params[0], ParamValue(3.0));

  ASSERT_EQ(graph.outputs.size(), 1u);
  EXPECT_EQ(graph.outputs[0].name, "page.txt");
  EXPECT_EQ(graph.nodes[graph.outputs[0].source.node].id, "page");
  EXPECT_EQ(graph.run.memory_bytes, 8000000000);
  EXPECT_EQ(graph.run.timeout_s, 600);
  ASSERT_EQ(graph.params.size(), 2u);
  EXPECT_TRUE(graph.params[0].path);
  EXPECT_EQ(graph.params[1].info.name, "amount");
}

}  // namespace
