// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/surface_map.h"

#include "nodes/phantom/head_view.h"

namespace face::phantom {

SurfaceMap surface_map(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head, const Camera& camera,
                       const SurfaceMapOptions& options) {
  const HeadView view = view_head(rig, weights, world_from_head, camera, options.width_px, options.height_px);
  return map_of(view.raster, view.screen, view.opaque);
}

}  // namespace face::phantom
