// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/length_unit.h"

#include <algorithm>
#include <limits>

namespace face::decode {

float mm_per_unit(LengthUnit unit, const std::vector<Vec3f>& points) {
  switch (unit) {
    case LengthUnit::mm:
      return 1;
    case LengthUnit::cm:
      return 10;
    case LengthUnit::m:
      return 1000;
    case LengthUnit::automatic:
      break;
  }
  float extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (const Vec3f& p : points) {
      low = std::min(low, p[k]);
      high = std::max(high, p[k]);
    }
    extent = std::max(extent, high - low);
  }
  return extent < 2.5f ? 1000.0f : extent < 100.0f ? 10.0f : 1.0f;
}

}  // namespace face::decode
