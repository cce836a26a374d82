// SPDX-License-Identifier: Apache-2.0
// NNLS of ten minutes of video, 18,000 frames of 30 coordinates over 7 shapes, one thread.
#include <benchmark/benchmark.h>

#include <cmath>

#include "nodes/base/random.h"
#include "nodes/weights/nnls.h"

namespace {

struct Problem {
  face::Matrix basis{30, 7, std::vector<double>(210)};
  face::Matrix targets{18000, 30, std::vector<double>(540000)};
};

// Weights that come and go smoothly (1), as in speech, or that are drawn anew for every frame (0).
Problem problem_of(bool smooth) {
  Problem problem;
  face::Random random(3);
  for (double& value : problem.basis.values) value = random.normal();
  for (std::size_t n = 0; n < 18000; ++n) {
    double weights[7];
    for (std::size_t k = 0; k < 7; ++k)
      weights[k] = smooth ? std::max(0.0, std::sin(0.05 * static_cast<double>(n) + 0.9 * static_cast<double>(k)))
                          : random.normal();
    for (std::size_t m = 0; m < 30; ++m) {
      double sum = 0.1 * random.normal();
      for (std::size_t k = 0; k < 7; ++k) sum += problem.basis.at(m, k) * weights[k];
      problem.targets.at(n, m) = sum;
    }
  }
  return problem;
}

void nnls_of_ten_minutes(benchmark::State& state) {
  const Problem problem = problem_of(state.range(0) != 0);
  double residual = 0;
  for (auto _ : state) {
    const face::weights::NnlsResult result = face::weights::nnls(problem.basis, problem.targets, nullptr);
    residual = result.kkt_residual;
    benchmark::DoNotOptimize(result.weights.values.data());
  }
  state.counters["kkt_residual"] = residual;
}
BENCHMARK(nnls_of_ten_minutes)->ArgName("smooth")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
