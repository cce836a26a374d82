// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "nodes/trajectory/gaussian_trajectory.h"

namespace face::trajectory {

// low <= sum_k row_k * x_(frame)k <= high. A side that does not bind is +-infinity.
struct FrameBound {
  std::size_t frame = 0;
  std::vector<double> row;  // dims
  double low = 0;
  double high = 0;
};

struct BoundedTrajectory {
  std::vector<double> values;  // frames x dims
  bool converged = false;      // false where the bounds contradict each other
  int iterations = 0;
};

// Where a piece of a longer trajectory is tied to the rest: the frame before the first and after the last. Either is dims long,
// or empty where the trajectory ends.
struct TrajectoryEnds {
  std::vector<double> before;
  std::vector<double> after;
};

// Minimises E of gaussian_trajectory.h subject to the bounds and 0 <= x <= 1, by a primal-dual interior point method
// (Mehrotra, On the Implementation of a Primal-Dual Interior Point Method, SIAM J. Optimization 2, 1992). Bounds couple values
// of one frame only, so each step is one banded Cholesky solve of half-bandwidth dims: O(frames x dims^3).
BoundedTrajectory solve_bounded_trajectory(const TrajectoryTargets& targets, double smoothness,
                                           const std::vector<FrameBound>& bounds, const TrajectoryEnds& ends = {});

}  // namespace face::trajectory
