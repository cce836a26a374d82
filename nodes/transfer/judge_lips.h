// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/rig.h"
#include "nodes/types/surface_map.h"
#include "nodes/types/table.h"

namespace face::transfer {

struct JudgeLipsOptions {
  double reach_mm = 15;
};

// Whether vertices that were looked up on a head follow the right lip. Those count whose true place lies within
// reach_mm of the inner lips, along the skin, and clearly on one side (lip_sides.h). places, truth: V x 1, of one head.
// One row "all": vertices (that count), wrong (found on the other side), lost (found nowhere).
Table judge_lips(const SurfaceMap& places, const SurfaceMap& truth, const Rig& head,
                 const JudgeLipsOptions& options = {});

}  // namespace face::transfer
