// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"

namespace face::model {

// The mean head of a morphable model and its expressions as a rig, so that it can be shown, exported, and given to
// texture's nodes: its own shapes "expression_0", ... follow 52 ARKit shapes that are empty and named in `missing`.
Rig head_rig(const MorphableModel& model);

}  // namespace face::model
