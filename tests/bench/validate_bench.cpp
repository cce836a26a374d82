// SPDX-License-Identifier: Apache-2.0
// Reading and validating graphs of 100 to 10,000 nodes. Expected: at most 50 ms for 1,000, and linear growth.
#include <benchmark/benchmark.h>

#include "tests/support/graph_files.h"

namespace {

// Chains of five nodes over a mapped sequence, with parameters, overrides and comments.
std::string graph_of(int count) {
  std::string text =
      R"({"facegraph": 1, "params": {"line": {"type": "path", "default": "line.txt"}, "amount": {"type": "real", "default": 2}},
  "nodes": {
    "text": {"node": "toy.read_text", "inputs": {"file": "${line}"}},
    "many": {"node": "toy.repeat", "inputs": {"text": "text"}, "params": {"times": 100}},
    "page": {"node": "toy.write_text", "inputs": {"text": "text"}})";
  for (int i = 0; i < count / 5; ++i) {
    const std::string id = std::to_string(i);
    text += ",\n    // chain " + id + "\n    \"loud" + id +
            R"(": {"node": "toy.upper", "inputs": {"text": "many"}, "overrides": {"1-9,12": {"mode": "lower"}}},
    "size)" +
            id + R"(": {"node": "toy.length", "inputs": {"text": "loud)" + id + R"("}},
    "mean)" +
            id + R"(": {"node": "toy.window_mean", "inputs": {"values": "size)" + id + R"("}},
    "sum)" + id +
            R"(": {"node": "toy.add", "inputs": {"a": "mean)" + id + R"(", "b": "size)" + id +
            R"([0017]"}, "params": {"amount": "${amount}"}},
    "total)" +
            id + R"(": {"node": "toy.running_sum", "inputs": {"value": "sum)" + id + "\"}}";
  }
  return text + "},\n  \"outputs\": {\"page.txt\": \"page\"}}";
}

void validate_graph(benchmark::State& state) {
  const test::GraphFiles files;
  files.write("line.txt", "hello");
  files.write("graph.json", graph_of(static_cast<int>(state.range(0))));
  const engine::GraphContext context = files.catalogue.context();
  for (auto _ : state) {
    const engine::GraphReading reading = engine::read_graph(files.path("graph.json"), {}, "/", context);
    if (!reading.problems.empty()) state.SkipWithError(reading.problems[0].line().c_str());
    benchmark::DoNotOptimize(reading.graph.nodes.data());
  }
  state.SetComplexityN(state.range(0));
}
BENCHMARK(validate_graph)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond)->Complexity(benchmark::oN);

}  // namespace

BENCHMARK_MAIN();
