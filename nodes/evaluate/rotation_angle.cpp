// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/rotation_angle.h"

#include <cmath>
#include <numbers>

namespace face::evaluate {

double rotation_angle_deg(const std::array<double, 9>& r) {
  // By sine and cosine both, as the arc cosine alone is blind to small angles.
  const double sine = std::hypot(r[7] - r[5], r[2] - r[6], r[3] - r[1]), cosine = r[0] + r[4] + r[8] - 1;
  return std::atan2(sine, cosine) * 180 / std::numbers::pi;
}

}  // namespace face::evaluate
