// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/surface_map.h"

#include "nodes/base/pose.h"
#include "nodes/phantom/head_view.h"
#include "nodes/render/camera.h"

namespace face::phantom {

SurfaceMap surface_map(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head, const Camera& camera,
                       const SurfaceMapOptions& options) {
  const OpaqueTriangles opaque = opaque_triangles(rig.neutral);
  const std::vector<render::ScreenPoint> screen =
      render::project(camera_in_head(camera, world_from_head), pose_points(rig, weights));
  render::RasterOptions raster_options;
  raster_options.width_px = options.width_px;
  raster_options.height_px = options.height_px;
  raster_options.culling = render::Culling::none;
  const render::Raster raster = render::rasterize(screen, opaque.mesh.triangles, raster_options);
  return map_of(raster, screen, opaque);
}

}  // namespace face::phantom
