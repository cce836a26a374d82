// SPDX-License-Identifier: Apache-2.0
// What the engine itself costs: tasks that do next to nothing, run into a fresh store, and the same graph again with
// nothing to do. The whole run is timed, from reading the graph to publishing; starting the process is not.
// per_task is CPU time of all threads: it holds on a busy machine too.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

#include "tests/support/toy_run.h"

namespace {

// A cheap sequence of numbers -> map -> map -> map -> gather: 3 * count + 1 tasks whose results are stored. Or a cheap
// map and a gather: count tasks whose results are handed on in memory.
class Chain {
 public:
  enum class Kind { stored, cheap };
  explicit Chain(std::int64_t count, Kind kind = Kind::stored) : plugins_({FACEGRAPH_PLUGIN_DIR}) {
    const std::string numbers =
        R"("numbers": {"node": "toy.count_up", "params": {"count": )" + std::to_string(count) + "}},\n";
    const std::string stored = R"(
    "one": {"node": "toy.add", "inputs": {"a": "numbers"}, "params": {"amount": 1}},
    "two": {"node": "toy.add", "inputs": {"a": "one"}, "params": {"amount": 2}},
    "three": {"node": "toy.add", "inputs": {"a": "two"}, "params": {"amount": 3}},
    "sum": {"node": "toy.sum_all", "inputs": {"numbers": "three"}},)";
    const std::string cheap = R"(
    "blobs": {"node": "toy.cheap_blob", "inputs": {"number": "numbers"}, "params": {"size_mb": 0.00001}},
    "sum": {"node": "toy.total_size", "inputs": {"blobs": "blobs"}},)";
    std::ofstream(folder_.path() / "graph.json")
        << R"({"facegraph": 1, "nodes": {)" << numbers << (kind == Kind::stored ? stored : cheap) << R"(
    "digits": {"node": "toy.number_text", "inputs": {"number": "sum"}},
    "file": {"node": "toy.write_text", "inputs": {"text": "digits"}}},
  "outputs": {"sum.txt": "file"}})";
    plugins_.load("toy.add");
    plugins_.digest("toy.add");
  }

  // Opens the store, reads and runs the graph; closes the store.
  engine::RunResult run() {
    const auto store = engine::Store::open((folder_.path() / "store").string());
    const auto reading = engine::read_graph((folder_.path() / "graph.json").string(), {}, folder_.path().string(),
                                            test::context_of(plugins_));
    engine::RunOptions options;
    options.out_folder = (folder_.path() / "out").string();
    return engine::run_graph(reading.graph, plugins_, *store, options);
  }
  void forget() {
    std::filesystem::remove_all(folder_.path() / "store");
    std::filesystem::remove_all(folder_.path() / "out");
  }

 private:
  test::TemporaryFolder folder_;
  engine::Plugins plugins_;
};

void per_task(benchmark::State& state, std::size_t tasks) {
  state.counters["tasks"] = static_cast<double>(tasks);
  state.counters["per_task"] = benchmark::Counter(static_cast<double>(tasks) * static_cast<double>(state.iterations()),
                                                  benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// Into a store that is new each time; says how many tasks ran.
std::size_t run_afresh(benchmark::State& state, Chain& chain) {
  std::size_t tasks = 0;
  for (auto _ : state) {
    state.PauseTiming();
    chain.forget();
    state.ResumeTiming();
    const engine::RunResult result = chain.run();
    tasks = result.tasks.run;
    if (!result.failures.empty()) state.SkipWithError(result.failures[0].c_str());
  }
  return tasks;
}

void measured(benchmark::internal::Benchmark* bench) { bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime(); }
template <std::int64_t many>
void few_and_many(benchmark::internal::Benchmark* bench) {
  measured(bench->ArgName("elements")->Arg(250)->Arg(many));
}

void store_small_tasks(benchmark::State& state) {
  Chain chain(state.range(0));
  per_task(state, run_afresh(state, chain));
}
BENCHMARK(store_small_tasks)->Apply(few_and_many<25'000>);

void rerun_with_nothing_to_do(benchmark::State& state) {
  Chain chain(state.range(0));
  chain.run();
  std::size_t tasks = 0;
  for (auto _ : state) {
    const engine::RunResult result = chain.run();
    tasks = result.tasks.reused;
    if (result.tasks.run > 0) state.SkipWithError("something ran");
  }
  per_task(state, tasks);
}
BENCHMARK(rerun_with_nothing_to_do)->Apply(few_and_many<25'000>);

// A cheap sequence of numbers -> cheap map -> one gather: 1 stored result, the rest stays in memory.
void pass_in_memory(benchmark::State& state) {
  Chain chain(state.range(0), Chain::Kind::cheap);
  run_afresh(state, chain);
  per_task(state, static_cast<std::size_t>(state.range(0)));  // cheap tasks are not counted as run
}
BENCHMARK(pass_in_memory)->Apply(few_and_many<75'000>);

// What a run costs before its first task.
void run_an_all_but_empty_graph(benchmark::State& state) {
  Chain chain(0);
  chain.run();
  for (auto _ : state) benchmark::DoNotOptimize(chain.run());
}
BENCHMARK(run_an_all_but_empty_graph)->Apply(measured);

}  // namespace
