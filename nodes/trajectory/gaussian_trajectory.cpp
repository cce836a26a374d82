// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/gaussian_trajectory.h"

#include <algorithm>

#include "nodes/base/check.h"

namespace face::trajectory {
namespace {

[[noreturn]] void nothing_pulls(const TrajectoryTargets& targets, double smoothness, std::size_t frame,
                                std::size_t dim) {
  double most = 0;
  for (std::size_t t = 0; t < targets.frames; ++t) most = std::max(most, targets.precision[t * targets.dims + dim]);
  if (most == 0)
    fail("nothing pulls dimension ", dim, " anywhere: its precision is 0 in all ", targets.frames, " frames");
  if (smoothness == 0)
    fail("nothing pulls dimension ", dim, " in frame ", frame,
         ": its precision is 0 there, and a smoothness of 0 ties it to no other frame");
  fail("nothing pulls dimension ", dim, ": its precision, at most ", most, ", is lost beside a smoothness of ",
       smoothness);
}

}  // namespace

std::vector<double> solve_trajectory(const TrajectoryTargets& targets, double smoothness) {
  const std::size_t frames = targets.frames, dims = targets.dims, count = frames * dims;
  check(targets.precision.size() == count && targets.target.size() == count, "precision has ", targets.precision.size(),
        " values and target ", targets.target.size(), ", expected ", frames, " x ", dims, " = ", count);
  check(smoothness >= 0, "smoothness is ", smoothness, ", expected 0 or more");
  // Thomas' algorithm, all dimensions side by side: ratio = what elimination leaves above the diagonal.
  std::vector<double> x(count), ratio(count);
  for (std::size_t t = 0; t < frames; ++t) {
    const double before = t > 0 ? smoothness : 0, after = t + 1 < frames ? smoothness : 0;
    for (std::size_t k = 0; k < dims; ++k) {
      const std::size_t i = t * dims + k;
      double diagonal = targets.precision[i] + before + after;
      double right = targets.precision[i] * targets.target[i];
      if (t > 0) {
        diagonal -= before * ratio[i - dims];
        right += before * x[i - dims];
      }
      if (!(diagonal > 0)) nothing_pulls(targets, smoothness, t, k);
      ratio[i] = after / diagonal;
      x[i] = right / diagonal;
    }
  }
  for (std::size_t i = count - (count > 0 ? dims : 0); i-- > 0;) x[i] += ratio[i] * x[i + dims];
  return x;
}

double smoothness_at(double smoothness, double reference_hz, double rate_hz) {
  const double ratio = rate_hz / reference_hz;
  return smoothness * ratio * ratio;
}

}  // namespace face::trajectory
