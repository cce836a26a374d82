// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/truth_flow.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/phantom/head_view.h"
#include "nodes/render/camera.h"

namespace face::phantom {
namespace {

void check_map(const SurfaceMap& map, std::size_t triangle_count, const char* name) {
  const std::size_t pixels =
      static_cast<std::size_t>(std::max(0, map.width)) * static_cast<std::size_t>(std::max(0, map.height));
  check(map.triangle.size() == pixels && map.weights.size() == pixels, name, " has ", map.triangle.size(),
        " triangles and ", map.weights.size(), " weights, expected ", pixels, " for ", map.width, " x ", map.height);
  for (const std::int32_t triangle : map.triangle)
    check(triangle >= -1 && triangle < static_cast<std::int32_t>(triangle_count), name, " shows triangle ", triangle,
          ", but the mesh has ", triangle_count);
}

// A surface point of a map, by the pixel that shows it.
Vec3f point_of(const SurfaceMap& map, std::size_t pixel, const std::vector<render::Triangle>& triangles,
               const std::vector<Vec3f>& points_mm) {
  const render::Triangle& t = triangles[static_cast<std::size_t>(map.triangle[pixel])];
  const float u = map.weights[pixel][0], v = map.weights[pixel][1];
  Vec3f point;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = u * points_mm[t[0]][axis] + v * points_mm[t[1]][axis] + (1 - u - v) * points_mm[t[2]][axis];
  return point;
}

}  // namespace

FlowField truth_flow(const Rig& rig, const SurfaceMap& reference, const SurfaceMap& target,
                     const Weights& target_weights, const RigidMotion* world_from_head, const Camera& camera,
                     const TruthFlowOptions& options) {
  const std::vector<render::Triangle> triangles = fan_triangles(rig.neutral);
  check_map(reference, triangles.size(), "reference");
  check_map(target, triangles.size(), "target");
  const std::vector<Vec3f> points_mm = pose_points(rig, target_weights);
  const Camera view = camera_in_head(camera, world_from_head);
  constexpr float nothing = 1e9f;
  std::vector<float> depth_mm(target.triangle.size(), nothing);
  for (std::size_t pixel = 0; pixel < depth_mm.size(); ++pixel)
    if (target.triangle[pixel] >= 0)
      depth_mm[pixel] = render::project(view, point_of(target, pixel, triangles, points_mm)).depth_mm;
  FlowField flow{reference.width, reference.height, {}, {}};
  flow.displacement_px.assign(reference.triangle.size(), Vec2f{0, 0});
  flow.valid.assign(reference.triangle.size(), 0);
  for (std::size_t pixel = 0; pixel < reference.triangle.size(); ++pixel) {
    if (reference.triangle[pixel] < 0) continue;
    const render::ScreenPoint at = render::project(view, point_of(reference, pixel, triangles, points_mm));
    const auto width = static_cast<std::size_t>(reference.width);
    flow.displacement_px[pixel] = {at.x_px - static_cast<float>(pixel % width),
                                   at.y_px - static_cast<float>(pixel / width)};
    const float x = std::floor(at.x_px), y = std::floor(at.y_px);
    if (!(at.depth_mm > 0 && x >= 0 && y >= 0 && at.x_px <= static_cast<float>(target.width - 1) &&
          at.y_px <= static_cast<float>(target.height - 1)))
      continue;
    const int right = std::min(static_cast<int>(x) + 1, target.width - 1);
    const int below = std::min(static_cast<int>(y) + 1, target.height - 1);
    float farthest = 0;
    bool covered = false;
    for (const int row : {static_cast<int>(y), below})
      for (const int column : {static_cast<int>(x), right}) {
        const float shown = depth_mm[static_cast<std::size_t>(row) * static_cast<std::size_t>(target.width) +
                                     static_cast<std::size_t>(column)];
        if (shown == nothing) continue;  // beside the silhouette
        covered = true;
        farthest = std::max(farthest, shown);
      }
    flow.valid[pixel] = covered && at.depth_mm <= farthest + static_cast<float>(options.tolerance_mm) ? 1 : 0;
  }
  return flow;
}

}  // namespace face::phantom
