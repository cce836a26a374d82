// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/bounded_trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nodes/base/random.h"
#include "tests/support/expect_throw_text.h"

namespace face::trajectory {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TrajectoryTargets random_targets(std::size_t frames, std::size_t dims) {
  Random random(8);
  TrajectoryTargets targets{frames, dims, {}, {}};
  for (std::size_t i = 0; i < frames * dims; ++i) {
    targets.precision.push_back(random.uniform(1, 40));
    targets.target.push_back(random.uniform());
  }
  return targets;
}

double energy(const TrajectoryTargets& targets, double smoothness, const std::vector<double>& x) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += targets.precision[i] * std::pow(x[i] - targets.target[i], 2);
    if (i >= targets.dims) sum += smoothness * std::pow(x[i] - x[i - targets.dims], 2);
  }
  return sum;
}

TEST(BoundedTrajectory, WithoutBoundsIsTheFreeOne) {
  const TrajectoryTargets targets = random_targets(60, 4);
  const BoundedTrajectory bounded = solve_bounded_trajectory(targets, 40, {});
  const std::vector<double> free = solve_trajectory(targets, 40);
  ASSERT_TRUE(bounded.converged);
  for (std::size_t i = 0; i < free.size(); ++i) EXPECT_NEAR(bounded.values[i], free[i], 1e-6);
}

TEST(BoundedTrajectory, ProjectsAOneFrameProblem) {
  // min 4 (x - 0.5)^2 + 1 (y - 0.5)^2 with x + y <= 0.5: the multiplier splits 0.5 as 1 : 4.
  const BoundedTrajectory solved =
      solve_bounded_trajectory({1, 2, {4.0, 1.0}, {0.5, 0.5}}, 1, {{0, {1.0, 1.0}, -infinity, 0.5}});
  ASSERT_TRUE(solved.converged);
  EXPECT_NEAR(solved.values[0], 0.4, 1e-7);
  EXPECT_NEAR(solved.values[1], 0.1, 1e-7);
}

TEST(BoundedTrajectory, MeetsEqualitiesAtTheirFramesAndBendsTheRestSmoothly) {
  TrajectoryTargets targets{41, 1, std::vector<double>(41, 4.0), std::vector<double>(41, 0.5)};
  const double smoothness = 36;  // tau of 3 frames
  const BoundedTrajectory solved = solve_bounded_trajectory(targets, smoothness, {{20, {1.0}, 0.1, 0.1 + 1e-6}});
  ASSERT_TRUE(solved.converged);
  EXPECT_NEAR(solved.values[20], 0.1, 2e-6);
  for (std::size_t i = 1; i <= 15; ++i) EXPECT_NEAR(solved.values[20 + i], solved.values[20 - i], 1e-6);
  // Away from the bound the deviation decays by the root of lambda z^2 - (precision + 2 lambda) z + lambda.
  const double b = (4 + 2 * smoothness) / smoothness, root = (b - std::sqrt(b * b - 4)) / 2;
  EXPECT_NEAR((0.5 - solved.values[24]) / (0.5 - solved.values[22]), root * root, 1e-5);
}

TEST(BoundedTrajectory, NoFeasiblePointIsBetter) {
  // Moving against any single value or pair, back into the bounds, never lowers the energy of the solution.
  const TrajectoryTargets targets = random_targets(12, 3);
  std::vector<FrameBound> bounds;
  for (std::size_t t = 3; t < 8; ++t) bounds.push_back({t, {20.0, -30.0, 2.0}, -0.1, 0.1});
  const BoundedTrajectory solved = solve_bounded_trajectory(targets, 10, bounds);
  ASSERT_TRUE(solved.converged);
  const double least = energy(targets, 10, solved.values);
  const auto feasible = [&](const std::vector<double>& x) {
    for (const double value : x)
      if (value < 0 || value > 1) return false;
    for (const FrameBound& bound : bounds) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += bound.row[k] * x[bound.frame * 3 + k];
      if (sum < bound.low || sum > bound.high) return false;
    }
    return true;
  };
  Random random(1);
  int tried = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<double> x = solved.values;
    const auto frame = static_cast<std::size_t>(random.uniform(0, 12));
    // Along the bounds, so that most steps are feasible.
    const double step = random.uniform(-0.05, 0.05), turn = random.uniform(-0.05, 0.05);
    x[frame * 3] += step;
    x[frame * 3 + 1] += (20 * step + 2 * turn) / 30;
    x[frame * 3 + 2] += turn;
    if (!feasible(x)) continue;
    ++tried;
    EXPECT_GE(energy(targets, 10, x), least - 1e-6);
  }
  EXPECT_GT(tried, 1000);
}

TEST(BoundedTrajectory, ContinuesAtItsEnds) {
  const TrajectoryTargets targets = random_targets(30, 2);
  const std::vector<double> whole = solve_trajectory(targets, 20);
  TrajectoryTargets piece{10, 2, {}, {}};
  piece.precision.assign(targets.precision.begin() + 20, targets.precision.begin() + 40);
  piece.target.assign(targets.target.begin() + 20, targets.target.begin() + 40);
  const BoundedTrajectory solved =
      solve_bounded_trajectory(piece, 20, {}, {{whole[18], whole[19]}, {whole[40], whole[41]}});
  ASSERT_TRUE(solved.converged);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(solved.values[i], whole[20 + i], 1e-6);
}

TEST(BoundedTrajectory, SaysThatContradictoryBoundsCannotBeMet) {
  const BoundedTrajectory solved = solve_bounded_trajectory({2, 1, {1.0, 1.0}, {0.5, 0.5}}, 1,
                                                            {{0, {1.0}, 0.6, infinity}, {0, {1.0}, -infinity, 0.2}});
  EXPECT_FALSE(solved.converged);
  for (const double value : solved.values) EXPECT_TRUE(value >= 0 && value <= 1);
}

TEST(BoundedTrajectory, BreaksAPricedBoundOnlyAsFarAsItMust) {
  // The hard bound holds x at 0.2 or less; the priced one, which asks for 0.6, is then missed by 0.4 and no more.
  const BoundedTrajectory solved = solve_bounded_trajectory(
      {2, 1, {1.0, 1.0}, {0.5, 0.5}}, 1, {{0, {1.0}, 0.6, infinity, 100.0}, {0, {1.0}, -infinity, 0.2}});
  ASSERT_TRUE(solved.converged);
  EXPECT_NEAR(solved.values[0], 0.2, 1e-7);
}

TEST(BoundedTrajectory, APriceThatIsHighEnoughIsNeverPaid) {
  const TrajectoryTargets targets = random_targets(20, 2);
  std::vector<FrameBound> hard = {{9, {3.0, -1.0}, 0.9, 1.0}}, priced = hard;
  priced[0].price = 1000;
  const BoundedTrajectory a = solve_bounded_trajectory(targets, 10, hard),
                          b = solve_bounded_trajectory(targets, 10, priced);
  ASSERT_TRUE(a.converged && b.converged);
  for (std::size_t i = 0; i < a.values.size(); ++i) EXPECT_NEAR(a.values[i], b.values[i], 1e-6);
}

TEST(BoundedTrajectory, KeepsToTheLargestStep) {
  TrajectoryTargets targets{40, 1, std::vector<double>(40, 50.0), std::vector<double>(40, 0.0)};
  for (std::size_t i = 20; i < 40; ++i) targets.target[i] = 1;
  const BoundedTrajectory solved = solve_bounded_trajectory(targets, 1, {}, {}, {0.2, 1e5});
  ASSERT_TRUE(solved.converged);
  for (std::size_t i = 1; i < 40; ++i) EXPECT_LE(solved.values[i] - solved.values[i - 1], 0.2 + 1e-6);
  EXPECT_NEAR(solved.values[39], 1, 1e-6);
}

TEST(BoundedTrajectory, OfNothingIsNothing) { EXPECT_TRUE(solve_bounded_trajectory({0, 2, {}, {}}, 1, {}).converged); }

TEST(BoundedTrajectory, RejectsABoundThatDoesNotFit) {
  EXPECT_THROW_TEXT(solve_bounded_trajectory({2, 1, {1.0, 1.0}, {0.5, 0.5}}, 1, {{2, {1.0, 2.0}, 0, 1}}),
                    "a bound on frame 2 has 2 coefficients, expected a frame below 2 and 1");
}

}  // namespace
}  // namespace face::trajectory
