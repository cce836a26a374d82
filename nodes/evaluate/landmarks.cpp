// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/landmarks.h"

#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"
#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::map<std::string, const Landmark*> by_name(const Landmarks& landmarks, const char* name, const std::string& frame) {
  std::map<std::string, const Landmark*> points;
  for (const Landmark& point : landmarks.points) {
    check(!point.valid || (std::isfinite(point.x_px) && std::isfinite(point.y_px)), name, " of frame ", frame,
          ": point ", point.name, " is at ", point.x_px, ", ", point.y_px, ", expected finite numbers");
    check(points.emplace(point.name, &point).second, name, " of frame ", frame, " has point ", point.name, " twice");
  }
  return points;
}

}  // namespace

LandmarksResult landmarks(const engine::Seq<Landmarks>& track, const engine::Seq<Landmarks>& truth,
                          const LandmarksOptions& options) {
  check_frame_counts(track.size(), truth.size(), "track", "truth");
  LandmarksResult result;
  result.frames.columns = {"nme_percent", "rms_px", "lost"};
  std::vector<double> nmes, distances;
  double failures = 0, judged_frames = 0, area = 0, lost = 0, wanted = 0;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const auto seen = track.at(i), true_ones = truth.at(i);
    const auto points = by_name(*seen, "track", track.id(i)), true_points = by_name(*true_ones, "truth", truth.id(i));
    std::vector<double> frame_px;
    double frame_lost = 0;
    for (const Landmark& q : true_ones->points) {
      if (!q.valid) continue;
      ++wanted;
      const auto p = points.find(q.name);
      if (p == points.end() || !p->second->valid)
        ++frame_lost;
      else
        frame_px.push_back(distance_px(*p->second, q));
    }
    const auto left = true_points.find(options.left_corner), right = true_points.find(options.right_corner);
    const bool has_eyes = left != true_points.end() && right != true_points.end() && left->second->valid &&
                          right->second->valid && distance_px(*left->second, *right->second) > 0;
    double nme = nothing;
    if (has_eyes) {
      ++judged_frames;
      if (!frame_px.empty()) {
        nme = 100 * mean_of(frame_px) / distance_px(*left->second, *right->second);
        nmes.push_back(nme);
        area += std::max(0.0, 1 - nme / options.failed_percent);
      }
      failures += frame_px.empty() || nme > options.failed_percent ? 1 : 0;
    }
    lost += frame_lost;
    distances.insert(distances.end(), frame_px.begin(), frame_px.end());
    result.frames.rows.push_back({track.id(i), {nme, rms_of(frame_px), frame_lost}});
  }
  result.table = one_row(
      "all",
      {"nme_percent", "failure_percent", "auc_percent", "rms_px", "p95_px", "lost_per_1000", "lost_per_1000_frames"},
      {mean_of(nmes), percent_of(failures, judged_frames), percent_of(area, judged_frames), rms_of(distances),
       quantile(distances, 0.95), 10 * percent_of(lost, wanted),
       10 * percent_of(lost, static_cast<double>(track.size()))});
  return result;
}

}  // namespace face::evaluate
