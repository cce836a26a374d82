// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/camera.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/surface_map.h"
#include "nodes/types/weights.h"

namespace face::phantom {

struct SurfaceMapOptions {
  int width_px = 640;
  int height_px = 480;
};

// Which point of a head every pixel of a camera shows: the truth beside a picture. Lashes are half transparent and not
// part of it. world_from_head null: at rest.
SurfaceMap surface_map(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head, const Camera& camera,
                       const SurfaceMapOptions& options = {});

}  // namespace face::phantom
