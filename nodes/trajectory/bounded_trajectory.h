// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <limits>
#include <vector>

#include "nodes/trajectory/gaussian_trajectory.h"

namespace face::trajectory {

// low <= sum_k row_k * x_(frame)k <= high. A side that does not bind is +-infinity.
struct FrameBound {
  std::size_t frame = 0;
  std::vector<double> row;  // dims
  double low = 0;
  double high = 0;
  // Energy per unit by which the bound is broken: a large price is kept exactly wherever it can be, and broken as
  // little as possible where not. Infinite = must hold.
  double price = std::numeric_limits<double>::infinity();
};

// No value changes by more than this from frame to frame, at a price as above.
struct StepBound {
  double largest = std::numeric_limits<double>::infinity();
  double price = std::numeric_limits<double>::infinity();
};

struct BoundedTrajectory {
  std::vector<double> values;  // frames x dims
  bool converged = false;      // false where the bounds contradict each other
  int iterations = 0;
};

// Where a piece of a longer trajectory is tied to the rest: the frame before the first and after the last. Either is
// dims long, or empty where the trajectory ends.
struct TrajectoryEnds {
  std::vector<double> before;
  std::vector<double> after;
};

// Minimises E of gaussian_trajectory.h subject to the bounds and 0 <= x <= 1, by a primal-dual interior point method
// (Mehrotra, On the Implementation of a Primal-Dual Interior Point Method, SIAM J. Optimization 2, 1992). Bounds couple
// values of one frame, or one value of two frames, so each iteration is one banded Cholesky solve of half-bandwidth
// dims: O(frames x dims^3).
BoundedTrajectory solve_bounded_trajectory(const TrajectoryTargets& targets, double smoothness,
                                           const std::vector<FrameBound>& bounds, const TrajectoryEnds& ends = {},
                                           const StepBound& steps = {});

}  // namespace face::trajectory
