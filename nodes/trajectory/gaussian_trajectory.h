// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

namespace face::trajectory {

// What a trajectory of `frames` x `dims` values is pulled to: the energy is
//   E(x) = sum_t sum_k precision_tk (x_tk - target_tk)^2 + smoothness * sum_t sum_k (x_tk - x_(t-1)k)^2.
// Row by row, frame after frame. precision >= 0, and > 0 somewhere in every dimension.
struct TrajectoryTargets {
  std::size_t frames = 0;
  std::size_t dims = 0;
  std::vector<double> precision;
  std::vector<double> target;
};

// Minimises E exactly, one tridiagonal system per dimension, O(frames x dims). (Ezzat, Geiger and Poggio, Trainable
// Videorealistic Speech Animation, SIGGRAPH 2002, with a diagonal covariance.) Every value is a mean of targets with
// positive weights, so it stays within their range. Returns frames x dims.
std::vector<double> solve_trajectory(const TrajectoryTargets& targets, double smoothness);

// smoothness at another frame rate that gives the same curve in time, when precision stays what it is per frame:
// smoothness x (rate / reference)^2.
double smoothness_at(double smoothness, double reference_hz, double rate_hz);

}  // namespace face::trajectory
