// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/gaussian_trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/random.h"
#include "tests/support/expect_throw_text.h"

namespace face::trajectory {
namespace {

TrajectoryTargets random_targets(std::size_t frames, std::size_t dims, std::uint64_t seed) {
  Random random(seed);
  TrajectoryTargets targets{frames, dims, {}, {}};
  for (std::size_t i = 0; i < frames * dims; ++i) {
    targets.precision.push_back(random.uniform(0.5, 40));
    targets.target.push_back(random.uniform());
  }
  return targets;
}

// The normal equations D^T Sigma^-1 D + lambda W^T W of all values at once, by Gaussian elimination with pivoting.
std::vector<double> solve_dense(const TrajectoryTargets& targets, double smoothness) {
  const std::size_t n = targets.frames * targets.dims;
  std::vector<std::vector<double>> a(n, std::vector<double>(n + 1, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    a[i][i] += targets.precision[i];
    a[i][n] = targets.precision[i] * targets.target[i];
    if (i < targets.dims) continue;
    const std::size_t j = i - targets.dims;
    a[i][i] += smoothness;
    a[j][j] += smoothness;
    a[i][j] -= smoothness;
    a[j][i] -= smoothness;
  }
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < n; ++r)
      if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
    std::swap(a[c], a[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const double factor = a[r][c] / a[c][c];
      for (std::size_t k = c; k <= n; ++k) a[r][k] -= factor * a[c][k];
    }
  }
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = a[i][n] / a[i][i];
  return x;
}

TEST(GaussianTrajectory, EqualsTheDenseSolution) {
  const TrajectoryTargets targets = random_targets(40, 5, 3);
  const std::vector<double> banded = solve_trajectory(targets, 40), dense = solve_dense(targets, 40);
  for (std::size_t i = 0; i < dense.size(); ++i) EXPECT_NEAR(banded[i], dense[i], 1e-12);
}

TEST(GaussianTrajectory, StaysWithinTheRangeOfItsTargets) {
  const TrajectoryTargets targets = random_targets(500, 3, 4);
  for (const double value : solve_trajectory(targets, 200)) {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
  }
}

TEST(GaussianTrajectory, WithoutSmoothnessIsTheTargets) {
  const TrajectoryTargets targets = random_targets(7, 2, 5);
  const std::vector<double> x = solve_trajectory(targets, 0);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], targets.target[i], 1e-15);
}

TEST(GaussianTrajectory, LeavesAStepWithTheTimeConstantOfTheTheory) {
  // A step decays as exp(-|t| / tau), tau = sqrt(lambda) sigma frames. With tau of 20 frames discretisation costs 1e-3.
  const double sigma = 2, smoothness = 100, tau = std::sqrt(smoothness) * sigma;
  TrajectoryTargets targets{1000, 1, std::vector<double>(1000, 1 / (sigma * sigma)), std::vector<double>(1000, 0.0)};
  for (std::size_t i = 500; i < 1000; ++i) targets.target[i] = 1;
  const std::vector<double> x = solve_trajectory(targets, smoothness);
  EXPECT_NEAR(x[460] / x[480], std::exp(-20 / tau), 1e-3);
}

TEST(GaussianTrajectory, GivesTheSameCurveAtAnotherRate) {
  const auto curve_at_half_a_second = [](double rate_hz) {
    const auto frames = static_cast<std::size_t>(rate_hz);
    TrajectoryTargets targets{frames, 1, std::vector<double>(frames, 4.0), std::vector<double>(frames, 0.0)};
    for (std::size_t i = 0; i < frames; ++i) targets.target[i] = std::sin(6 * static_cast<double>(i) / rate_hz);
    return solve_trajectory(targets, smoothness_at(10, 30, rate_hz))[frames / 2];
  };
  // The sums are rectangle rules: their error falls with the frame length, 3 % of the range at 30 Hz.
  EXPECT_NEAR(curve_at_half_a_second(30), curve_at_half_a_second(240), 0.03);
  EXPECT_NEAR(curve_at_half_a_second(120), curve_at_half_a_second(240), 0.006);
}

TEST(GaussianTrajectory, OfNothingIsNothing) { EXPECT_TRUE(solve_trajectory({0, 3, {}, {}}, 10).empty()); }

TEST(GaussianTrajectory, OfOneFrameIsItsTarget) {
  EXPECT_DOUBLE_EQ(solve_trajectory({1, 1, {2.0}, {0.25}}, 10)[0], 0.25);
}

TEST(GaussianTrajectory, RejectsUnequalCounts) {
  EXPECT_THROW_TEXT(solve_trajectory({2, 3, std::vector<double>(6, 1.0), std::vector<double>(5, 1.0)}, 1),
                    "precision has 6 values and target 5, expected 2 x 3 = 6");
}

TEST(GaussianTrajectory, RejectsADimensionThatNothingPulls) {
  EXPECT_THROW_TEXT(solve_trajectory({2, 1, {0.0, 0.0}, {1.0, 1.0}}, 0),
                    "nothing pulls dimension 0 anywhere: its precision is 0 in all 2 frames");
  EXPECT_THROW_TEXT(
      solve_trajectory({2, 2, {1, 1, 1, 0}, {0, 0, 0, 0}}, 0),
      "nothing pulls dimension 1 in frame 1: its precision is 0 there, and a smoothness of 0 ties it to no "
      "other frame");
  EXPECT_THROW_TEXT(solve_trajectory({2, 1, {1e-308, 1e-308}, {0, 0}}, 10),
                    "nothing pulls dimension 0: its precision, at most 1e-308, is lost beside a smoothness of 10");
}

}  // namespace
}  // namespace face::trajectory
