// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/vertex_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/draw_heat_map.h"
#include "nodes/evaluate/regions.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {

VertexErrors::VertexErrors(const Rig& rig, std::vector<std::uint32_t> lips)
    : rig_(rig), lips_(std::move(lips)), skin_(skin_vertices(rig)), sum_mm_(rig.neutral.points_mm.size(), 0) {
  check(!skin_.empty(), "the rig has no vertices to judge");
}

void VertexErrors::add(const std::string& frame, const std::vector<Vec3f>& points, const std::vector<Vec3f>& truth) {
  double worst = 0, sum = 0;
  for (const std::uint32_t v : lips_) worst = std::max(worst, std::sqrt(squared_distance(points.at(v), truth.at(v))));
  for (const std::uint32_t v : skin_) {
    const double error = std::sqrt(squared_distance(points.at(v), truth.at(v)));
    sum += error;
    sum_mm_[v] += error;
  }
  frames_.push_back(frame);
  valid_.push_back(true);
  worst_mm_.push_back(worst);
  mean_mm_.push_back(sum / static_cast<double>(skin_.size()));
}

void VertexErrors::lose(const std::string& frame) {
  frames_.push_back(frame);
  valid_.push_back(false);
}

VertexErrorResult VertexErrors::result(double readable_mm, double full_scale_mm) const {
  const double root = rms_of(worst_mm_);
  VertexErrorResult result;
  result.table =
      one_row("all", {"lve_mm2", "lip_error_mm", "worst_lip_mm", "mve_mm", "readable_percent", "lost_frames"},
              {root * root, root, mean_of(worst_mm_), mean_of(mean_mm_), percent_within(worst_mm_, readable_mm),
               static_cast<double>(frames_.size() - worst_mm_.size())});
  result.frames.columns = {"worst_lip_mm", "mean_vertex_mm", "valid"};
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0, judged = 0; i < frames_.size(); ++i) {
    if (valid_[i])
      result.frames.rows.push_back({frames_[i], {worst_mm_[judged], mean_mm_[judged], 1}});
    else
      result.frames.rows.push_back({frames_[i], {nothing, nothing, 0}});
    judged += valid_[i] ? 1 : 0;
  }
  std::vector<double> mean = sum_mm_;
  for (double& value : mean) value /= static_cast<double>(std::max<std::size_t>(1, worst_mm_.size()));
  result.heat_map = draw_heat_map(rig_, mean, full_scale_mm);
  return result;
}

}  // namespace face::evaluate
