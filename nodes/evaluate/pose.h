// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/table.h"

namespace face::evaluate {

struct PoseResult {
  Table table;   // row "all"
  Table frames;  // rotation_deg, translation_mm per frame
};

// Head poses beside the true ones. Per frame: rotation_deg, the angle of the rotation between them (0 to 180), and
// translation_mm, the distance of where they put the origin. Over frames: mean, p95 and max of both.
PoseResult pose(const engine::Seq<RigidMotion>& motion, const engine::Seq<RigidMotion>& truth);

}  // namespace face::evaluate
