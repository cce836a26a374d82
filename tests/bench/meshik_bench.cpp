// SPDX-License-Identifier: Apache-2.0
// MeshIK at the size of the papers' face: 3,201 vertices, 5,825 triangles, one thread.
#include <benchmark/benchmark.h>

#include <cmath>

#include "nodes/meshik/prepare.h"
#include "nodes/meshik/reconstruct.h"
#include "nodes/meshik/solve.h"
#include "tests/nodes/meshik/bent_sheet.h"

namespace {

face::MeshSpace space_of(std::size_t examples) {
  test::BentSheet sheet = test::bent_sheet(97, 33, examples, 19);
  sheet.triangles.resize(3 * 5825);
  return face::meshik::prepare_triangles(sheet.reference_mm, sheet.triangles, sheet.examples_mm);
}

void prepare_seven_examples(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(space_of(7));
}
BENCHMARK(prepare_seven_examples)->Unit(benchmark::kMillisecond);

void reconstruct_a_frame(benchmark::State& state) {
  const face::MeshSpace space = space_of(7);
  std::vector<double> weights(7);
  std::size_t frame = 0;
  for (auto _ : state) {
    for (std::size_t k = 0; k < 7; ++k) weights[k] = 0.3 + 0.3 * std::sin(0.1 * static_cast<double>(frame * (k + 1)));
    benchmark::DoNotOptimize(face::meshik::reconstruct_vertices(space, weights));
    ++frame;
  }
  state.counters["frames_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["factor"] = static_cast<double>(space.values.size());
}
BENCHMARK(reconstruct_a_frame)->Unit(benchmark::kMicrosecond);

// x and y of 48 vertices in the middle of the sheet, of a performance at 30 frames per second.
struct Performance {
  face::MeshSpace space = space_of(20);
  std::vector<face::VertexTargets> frames;

  Performance() {
    for (std::size_t t = 0; t < 60; ++t) {
      std::vector<double> weights(20);
      for (std::size_t k = 0; k < 20; ++k)
        weights[k] = std::max(0.0, 0.35 * std::sin(0.15 * static_cast<double>(t) + 2.1 * static_cast<double>(k)));
      const std::vector<double> vertices = face::meshik::reconstruct_vertices(space, weights);
      frames.emplace_back();
      for (std::size_t i = 0; i < 48; ++i) {
        const std::size_t v = (6 + 3 * (i / 8)) * 97 + 20 + 7 * (i % 8);
        frames.back().targets.push_back(
            {static_cast<std::uint32_t>(v), vertices[3 * v], vertices[3 * v + 1], 0, false});
      }
    }
  }
};

// warm: from the weights of the frame before; node: everything that is made per set of constraints made for every
// frame.
void solve_a_frame(benchmark::State& state) {
  const Performance performance;
  const bool warm = state.range(0) != 0, node = state.range(1) != 0;
  const face::meshik::MeshIkSolver kept(performance.space, performance.frames[0]);
  const std::vector<double> zero(20, 0.0);
  std::vector<double> weights = kept.solve_vertices(performance.frames[0], zero, {}).weights;
  std::size_t frame = 0;
  double iterations = 0;
  for (auto _ : state) {
    const face::VertexTargets& targets = performance.frames[++frame % performance.frames.size()];
    const std::vector<double>& start = warm ? weights : zero;
    const auto found = node ? face::meshik::MeshIkSolver(performance.space, targets).solve_vertices(targets, start, {})
                            : kept.solve_vertices(targets, start, {});
    weights = found.weights;
    iterations += static_cast<double>(found.iterations);
    if (!found.converged) state.SkipWithError("a frame did not converge");
  }
  state.counters["frames_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["steps"] = iterations / static_cast<double>(state.iterations());
}
BENCHMARK(solve_a_frame)
    ->ArgNames({"warm", "node"})
    ->Args({1, 0})
    ->Args({1, 1})
    ->Args({0, 0})
    ->Unit(benchmark::kMillisecond);

}  // namespace
