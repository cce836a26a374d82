// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/pose.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/rotation_angle.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {
namespace {

void check_motion(const RigidMotion& motion, const char* name, const std::string& frame) {
  for (const double value : motion.rotation)
    check(std::isfinite(value), name, " of frame ", frame, ": its rotation has the entry ", value,
          ", expected a finite number");
  for (const double value : motion.translation_mm)
    check(std::isfinite(value), name, " of frame ", frame, ": its translation has the entry ", value,
          ", expected a finite number");
}

double angle_deg(const RigidMotion& a, const RigidMotion& b) {
  std::array<double, 9> from_a_to_b{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) from_a_to_b[3 * i + j] += a.rotation[3 * k + i] * b.rotation[3 * k + j];
  return rotation_angle_deg(from_a_to_b);
}

}  // namespace

PoseResult pose(const engine::Seq<RigidMotion>& motion, const engine::Seq<RigidMotion>& truth) {
  check_frame_counts(motion.size(), truth.size(), "motion", "truth");
  PoseResult result;
  result.frames.columns = {"rotation_deg", "translation_mm"};
  std::vector<double> angles, distances;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const auto own = motion.at(i), real = truth.at(i);
    check_motion(*own, "motion", motion.id(i));
    check_motion(*real, "truth", truth.id(i));
    double squared = 0;
    for (std::size_t c = 0; c < 3; ++c) squared += std::pow(own->translation_mm[c] - real->translation_mm[c], 2);
    angles.push_back(angle_deg(*own, *real));
    distances.push_back(std::sqrt(squared));
    result.frames.rows.push_back({motion.id(i), {angles.back(), distances.back()}});
  }
  result.table = one_row("all",
                         {"rotation_mean_deg", "rotation_p95_deg", "rotation_max_deg", "translation_mean_mm",
                          "translation_p95_mm", "translation_max_mm"},
                         {mean_of(angles), quantile(angles, 0.95), largest_of(angles), mean_of(distances),
                          quantile(distances, 0.95), largest_of(distances)});
  return result;
}

}  // namespace face::evaluate
