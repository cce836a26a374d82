// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

namespace face::evaluate {

// By how many degrees a rotation, row by row, turns: 0 to 180.
double rotation_angle_deg(const std::array<double, 9>& rotation);

}  // namespace face::evaluate
