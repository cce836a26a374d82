// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "engine/port.h"
#include "nodes/decode/length_unit.h"
#include "nodes/types/morphable_model.h"

namespace face::decode {

// Reads a model of the SMPL family from an NPZ (Li et al., Learning a Model of Facial Shape and Expression from 4D
// Scans, SIGGRAPH Asia 2017: FLAME): arrays v_template (V x 3), f (F x 3) and shapedirs (V x 3 x K), of whose
// components the first `identities` are the person's and the others expressions; all are at one standard deviation.
// Where weights (V x J) and J_regressor (J x V) are there, the jaw (joint 2 of FLAME) opening by 0.15 radian is one
// expression more, in its linear part: FLAME opens the mouth by that joint. Pose correctives, neck and eyes are left
// out. No albedo, no landmarks.
MorphableModel read_flame_model(const engine::File& file, std::size_t identities, LengthUnit unit);

}  // namespace face::decode
