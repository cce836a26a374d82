// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/start_flow.h"

#include <cmath>
#include <map>

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"

namespace face::flow {
namespace {

struct Pull {
  double x_px, y_px;  // in the reference
  double u_px, v_px;  // beyond the rigid motion
};

}  // namespace

FlowField start_flow(const DepthScan& reference, const DepthScan& target, const Landmarks* reference_markers,
                     const Landmarks* target_markers, const StartFlowOptions& options) {
  check_scan(reference, "reference");
  check_scan(target, "target");
  const int width = reference.picture.width, height = reference.picture.height;
  const ScanRays rays(reference.camera);
  std::vector<Pull> pulls;
  if (reference_markers && target_markers) {
    std::map<std::string, const Landmark*> found;
    for (const Landmark& point : target_markers->points)
      if (point.valid) found[point.name] = &point;
    for (const Landmark& point : reference_markers->points) {
      const auto there = found.find(point.name);
      const float depth = depth_at(reference, point.x_px, point.y_px);
      if (!point.valid || there == found.end() || !(depth > 0)) continue;
      const ScanPixel rigid = pixel_of(target.camera, rays.point(point.x_px, point.y_px, depth));
      pulls.push_back({point.x_px, point.y_px, there->second->x_px - rigid.x_px, there->second->y_px - rigid.y_px});
    }
  }
  FlowField field{width, height, {}, {}};
  field.displacement_px.assign(reference.depth_mm.size(), {0, 0});
  field.valid.assign(reference.depth_mm.size(), 0);
  // The markers' share varies slowly: found on a grid of 8 pixels, bilinear between.
  constexpr int step = 8;
  const int columns = width / step + 2, rows = height / step + 2;
  std::vector<Vec2f> bend(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), Vec2f{0, 0});
  const double inverse = 0.5 / (options.reach_px * options.reach_px);
  for (int r = 0; r < rows && !pulls.empty(); ++r)
    for (int c = 0; c < columns; ++c) {
      double weight = 0.05, u = 0, v = 0;  // the rigid motion, as a marker would pull at 2.4 times the reach
      for (const Pull& pull : pulls) {
        const double dx = pull.x_px - c * step, dy = pull.y_px - r * step;
        const double w = std::exp(-(dx * dx + dy * dy) * inverse);
        weight += w;
        u += w * pull.u_px;
        v += w * pull.v_px;
      }
      bend[static_cast<std::size_t>(r * columns + c)] = {static_cast<float>(u / weight),
                                                         static_cast<float>(v / weight)};
    }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (!(reference.depth_mm[i] > 0)) continue;
      const ScanPixel rigid = pixel_of(target.camera, rays.point(x, y, reference.depth_mm[i]));
      if (!(rigid.depth_mm > 0)) continue;
      const float fx = static_cast<float>(x % step) / step, fy = static_cast<float>(y % step) / step;
      const Vec2f* corner = bend.data() + static_cast<std::size_t>(y / step * columns + x / step);
      field.valid[i] = 1;
      for (std::size_t k = 0; k < 2; ++k) {
        const float above = corner[0][k] + fx * (corner[1][k] - corner[0][k]);
        const float below = corner[columns][k] + fx * (corner[columns + 1][k] - corner[columns][k]);
        const double moved = k == 0 ? rigid.x_px - x : rigid.y_px - y;
        field.displacement_px[i][k] = static_cast<float>(moved) + above + fy * (below - above);
      }
    }
  return field;
}

}  // namespace face::flow
