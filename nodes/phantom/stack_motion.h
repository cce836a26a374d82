// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/matrix.h"
#include "nodes/types/rigid_motion.h"

namespace face::phantom {

// A motion over time as one matrix, T x 12: the rotation's rows, then the translation in mm.
Matrix stack_motion(const engine::Seq<RigidMotion>& motion);

}  // namespace face::phantom
