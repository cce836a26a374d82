// SPDX-License-Identifier: Apache-2.0
// Affinity propagation of ten minutes of video: 18,000 frames of 30 coordinates in 21 planted groups, small and large.
#include <benchmark/benchmark.h>

#include "nodes/cluster/affinity_propagation.h"
#include "tests/nodes/cluster/planted_groups.h"

namespace {

void affinity_propagation(benchmark::State& state) {
  const test::PlantedGroups groups = test::planted_groups(static_cast<std::size_t>(state.range(0)), 30, 21);
  face::cluster::AffinityPropagationOptions options;
  options.method = state.range(1) != 0 ? face::cluster::AffinityMethod::pruned : face::cluster::AffinityMethod::exact;
  options.damping = static_cast<double>(state.range(2)) / 100;
  engine::Progress progress;
  face::cluster::AffinityPropagationResult result;
  for (auto _ : state) result = face::cluster::affinity_propagation(groups.points, options, progress);
  state.counters["groups"] = static_cast<double>(result.exemplars.rows);
  state.counters["similarity"] = result.similarity;
  state.counters["preference"] = result.preference;
  state.counters["iterations"] = static_cast<double>(result.iterations);
  state.counters["converged"] = result.converged;
}
BENCHMARK(affinity_propagation)
    ->ArgNames({"points", "pruned", "damping_percent"})
    ->ArgsProduct({{2000}, {0, 1}, {50, 90}})
    ->Args({18000, 0, 90})
    ->Args({18000, 1, 90})
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace
