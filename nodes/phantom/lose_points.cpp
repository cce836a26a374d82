// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/lose_points.h"

#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/phantom/head_view.h"
#include "nodes/phantom/scanner_view.h"
#include "nodes/phantom/sensor_noise.h"
#include "nodes/render/camera.h"

namespace face::phantom {
namespace {

// One random number for every cube of the neutral head, so that neighbours share their fate.
bool is_forgetful(const Vec3f& neutral_mm, const PixelNoise& noise, double share) {
  constexpr float patch_mm = 4;
  std::uint64_t cell = 0;
  for (const float coordinate : neutral_mm)
    cell = cell << 20 | (static_cast<std::uint64_t>(std::floor(coordinate / patch_mm) + 524288.0f) & 0xfffff);
  return noise.uniform(cell) < static_cast<float>(share);
}

}  // namespace

LosePointsResult lose_points(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head,
                             const Camera& camera, const Camera& projector,
                             const engine::Prior<LosePointsResult>& before, const LosePointsOptions& options) {
  constexpr float hidden_mm = 1.5f;
  const std::vector<Vec3f> points_mm = pose_points(rig, weights);
  const OpaqueTriangles opaque = opaque_triangles(rig.neutral);
  LosePointsResult result;
  if (before) {
    check(before->lost.on.size() == points_mm.size(), "the frame before has ", before->lost.on.size(),
          " vertices, but the rig ", points_mm.size());
    result.lost = before->lost;
  } else {
    result.lost.on.assign(points_mm.size(), 0);
  }
  const PixelNoise noise(options.seed, "lost", 0);
  const auto look = [&](const Camera& from, int width_px, int height_px) {
    const std::vector<render::ScreenPoint> screen = render::project(camera_in_head(from, world_from_head), points_mm);
    render::RasterOptions raster_options;
    raster_options.width_px = width_px;
    raster_options.height_px = height_px;
    raster_options.culling = render::Culling::none;
    const render::Raster raster = render::rasterize(screen, opaque.mesh.triangles, raster_options);
    for (std::size_t v = 0; v < screen.size(); ++v)
      if (result.lost.on[v] == 0 && !is_seen(raster, screen[v], hidden_mm) &&
          is_forgetful(rig.neutral.points_mm[v], noise, options.share))
        result.lost.on[v] = 1;
  };
  look(camera, options.width_px, options.height_px);
  look(projector, options.projector_width_px, options.projector_height_px);
  return result;
}

}  // namespace face::phantom
