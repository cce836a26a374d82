// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/camera.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/surface_map.h"
#include "nodes/types/weights.h"

namespace face::phantom {

struct TruthFlowOptions {
  double tolerance_mm = 1;  // a point this far behind what the target shows there is hidden
};

// The true flow of a face between two frames: what reference pixels show, followed to where the target camera sees it.
// Exact: the surface point of every reference pixel is posed and projected as in the target frame. valid is 0 for the
// background, for points outside the target's picture, and for those that the target hides (none of the four target
// pixels about the place shows anything as far away as the point).
// reference, target: maps of the same mesh, with or without equal sizes. target_weights, world_from_head (null: at
// rest), camera: those of the target frame.
FlowField truth_flow(const Rig& rig, const SurfaceMap& reference, const SurfaceMap& target,
                     const Weights& target_weights, const RigidMotion* world_from_head, const Camera& camera,
                     const TruthFlowOptions& options = {});

}  // namespace face::phantom
