// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/image.h"
#include "nodes/types/rig.h"

namespace face::evaluate {

// The neutral head from the front and from its left, with a colour for the error of every vertex of the skin and a
// scale in mm beside it: dark blue = 0, green = half, dark red = full_scale_mm and more. Hair, brows and lashes are
// left out; what is no skin is grey. error_mm: V, finite.
Image draw_heat_map(const Rig& rig, const std::vector<double>& error_mm, double full_scale_mm);

}  // namespace face::evaluate
