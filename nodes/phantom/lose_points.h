// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/camera.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/vertex_mask.h"
#include "nodes/types/weights.h"

namespace face::phantom {

struct LosePointsOptions {
  int width_px = 640;
  int height_px = 480;
  int projector_width_px = 1024;
  int projector_height_px = 768;
  double share = 1;  // of the points that go out of sight, in patches of a few mm, how many are lost; 0 = none
  std::int64_t seed = 1;
};

struct LosePointsResult {
  VertexMask lost;
};

// What a scanner with incremental depth update cannot measure any more: "only surface points that were visible in the
// first frame can be reconstructed in subsequent scans. A point that disappears during the sequence is lost and cannot
// be recognized when it reappears" (the scan stream paper, section 2). A vertex is out of sight where camera or
// projector do not see it by more than 1.5 mm. Lost stays lost, so a mouth that opens from closed lips is empty.
// before: the result of the frame before; empty at the first of a take.
LosePointsResult lose_points(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head,
                             const Camera& camera, const Camera& projector,
                             const engine::Prior<LosePointsResult>& before, const LosePointsOptions& options = {});

}  // namespace face::phantom
