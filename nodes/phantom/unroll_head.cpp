// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/unroll_head.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "nodes/base/check.h"

namespace face::phantom {

constexpr float far_mm = 1000;  // no head reaches so far from its axis

UnrolledHead unroll_head(const std::vector<Vec3f>& points_mm, const std::vector<render::Triangle>& triangles,
                         const std::vector<bool>& left_out, const LaserScanOptions& options) {
  const auto columns = static_cast<float>(options.columns);
  const float per_rad = columns / (2 * std::numbers::pi_v<float>);
  UnrolledHead unrolled;
  std::vector<render::ScreenPoint> screen(points_mm.size());
  for (std::size_t v = 0; v < points_mm.size(); ++v) {
    const float x = points_mm[v][0] - static_cast<float>(options.axis_x_mm);
    const float z = points_mm[v][2] - static_cast<float>(options.axis_z_mm);
    const float radius = std::hypot(x, z);
    check(radius < far_mm, "vertex ", v, " is ", radius, " mm from the axis, expected less than ", far_mm);
    // The rasteriser keeps the larger 1 / depth: here the outermost.
    screen[v] = {0.5f * (columns - 1) + per_rad * std::atan2(x, z),
                 static_cast<float>((options.top_mm - points_mm[v][1]) / options.step_mm), far_mm / radius};
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (left_out[t]) continue;
    std::array<render::ScreenPoint, 3> corner;
    float least = 1e9f, most = -1e9f;
    for (std::size_t i = 0; i < 3; ++i) {
      corner[i] = screen[triangles[t][i]];
      const float turn = std::round((corner[i].x_px - corner[0].x_px) / columns);
      corner[i].x_px -= columns * turn;
      least = std::min(least, corner[i].x_px);
      most = std::max(most, corner[i].x_px);
    }
    if (most - least > 0.45f * columns) continue;  // about the axis itself, at the crown, where scanners see nothing
    const auto add = [&](float shift) {
      const auto first = static_cast<std::uint32_t>(unrolled.corners.size());
      for (render::ScreenPoint point : corner) {
        point.x_px += shift;
        unrolled.corners.push_back(point);
      }
      unrolled.triangles.push_back({first, first + 1, first + 2});
      unrolled.source.push_back(static_cast<std::uint32_t>(t));
    };
    add(0);
    if (least < 0) add(columns);
    if (most > columns - 1) add(-columns);
  }
  return unrolled;
}

}  // namespace face::phantom
