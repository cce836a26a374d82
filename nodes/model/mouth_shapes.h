// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::model {

// Five mouths to try a fitted face with: "closed", "open", "round", "wide", "smile".
void mouth_shapes(const Rig& rig, engine::SeqWriter<Weights>& weights);

}  // namespace face::model
