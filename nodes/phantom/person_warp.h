// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/phantom/vector3.h"
#include "nodes/types/matrix.h"
#include "nodes/types/rig.h"

namespace face::phantom {

// Bends a person by a smooth field of space that no linear model contains: ten waves of 90 to 200 mm in random
// directions, without their rigid part, `rms_mm` over the skin of the face. Teeth, gums and tongue move as one solid,
// so does each eyeball; the skin around them goes over into their motion. The shapes are carried along by the field's
// Jacobian J at their vertex, offset' = J offset (for solids their rotation), so that what meets in the rig's poses
// meets in the person's: lips that lie on each other have one J.
// Returns what the neutral's vertices moved by, V x 3, mm.
Matrix warp_person(std::int64_t seed, double rms_mm, Rig& person);

}  // namespace face::phantom
