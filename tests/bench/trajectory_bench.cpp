// SPDX-License-Identifier: Apache-2.0
// The plain Gaussian trajectory of 1,000 frames in 7 dimensions.
#include <benchmark/benchmark.h>

#include "nodes/base/random.h"
#include "nodes/trajectory/gaussian_trajectory.h"

namespace {

void trajectory_of_a_thousand_frames(benchmark::State& state) {
  face::trajectory::TrajectoryTargets targets{1000, 7, {}, {}};
  face::Random random(3);
  for (std::size_t i = 0; i < 7000; ++i) {
    targets.precision.push_back(random.uniform(0.5, 100));
    targets.target.push_back(random.normal());
  }
  for (auto _ : state) benchmark::DoNotOptimize(face::trajectory::solve_trajectory(targets, 10));
}
BENCHMARK(trajectory_of_a_thousand_frames)->Unit(benchmark::kMicrosecond);

}  // namespace
