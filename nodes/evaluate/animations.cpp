// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/animations.h"

#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"

namespace face::evaluate {

void check_frame_counts(std::size_t count, std::size_t other_count, const char* name, const char* other) {
  check(count > 0, name, " has no frames to judge");
  check(count == other_count, name, " has ", count, " frames, ", other, " has ", other_count);
}

void check_times(std::size_t frame_count, const Timeline& timeline, const char* name) {
  check(timeline.time_s.size() == frame_count, name, " has ", frame_count, " frames, timeline has ",
        timeline.time_s.size());
  for (std::size_t i = 0; i < timeline.time_s.size(); ++i) {
    check(std::isfinite(timeline.time_s[i]), "time ", i, " of the timeline is ", timeline.time_s[i],
          ", expected a finite number");
    if (i > 0)
      check(timeline.time_s[i] > timeline.time_s[i - 1], "time ", i, " of the timeline is ", timeline.time_s[i],
            " s, expected more than ", timeline.time_s[i - 1], " s");
  }
}

std::vector<Vec3f> posed(const Rig& rig, const Weights& weights, const char* name, const std::string& frame) {
  for (std::size_t i = 0; i < weights.values.size(); ++i)
    check(std::isfinite(weights.values[i]), name, " of frame ", frame, ": weight ", i, " is ", weights.values[i],
          ", expected a finite number");
  std::vector<Vec3f> points = pose_points(rig, weights);
  for (std::size_t v = 0; v < points.size(); ++v)
    for (const float coordinate : points[v])
      check(std::isfinite(coordinate), "the rig, posed for ", name, " of frame ", frame, ": vertex ", v,
            " has the coordinate ", coordinate, ", expected a finite number");
  return points;
}

void check_points(const MeshPoints& points, std::size_t vertex_count, const char* name, const std::string& frame) {
  check(points.points_mm.size() == vertex_count, name, " of frame ", frame, " has ", points.points_mm.size(),
        " vertices, expected ", vertex_count);
  for (std::size_t v = 0; v < points.points_mm.size(); ++v)
    for (const float coordinate : points.points_mm[v])
      check(std::isfinite(coordinate), name, " of frame ", frame, ": vertex ", v, " has the coordinate ", coordinate,
            ", expected a finite number");
}

void for_each_pose(const Rig& rig, const engine::Seq<Weights>& weights, const engine::Seq<Weights>& truth,
                   const VisitPair& visit) {
  check_frame_counts(weights.size(), truth.size(), "weights", "truth");
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const std::vector<Vec3f> points = posed(rig, *weights.at(i), "weights", weights.id(i));
    visit(i, points, posed(rig, *truth.at(i), "truth", truth.id(i)));
  }
}

double squared_distance(const Vec3f& a, const Vec3f& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = double{a[i]} - b[i];
    sum += d * d;
  }
  return sum;
}

}  // namespace face::evaluate
