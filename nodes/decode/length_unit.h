// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/vec.h"

namespace face::decode {

// The unit in which a file gives lengths.
enum class LengthUnit { automatic, mm, cm, m };

// Factor from the file's unit to mm. automatic goes by the largest extent of the points: below 2.5 it is metres (a head
// is 0.2 to 0.4, a whole person 1.8), below 100 cm (a bust is 20 to 80), else mm.
float mm_per_unit(LengthUnit unit, const std::vector<Vec3f>& points);

}  // namespace face::decode
