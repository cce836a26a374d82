// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/despike.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/quantile.h"

namespace face::flow {
namespace {

std::array<float, 8> neighbours(const Plane& plane, int x, int y) {
  std::array<float, 8> out;
  std::size_t n = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (dx != 0 || dy != 0)
        out[n++] = plane.row(std::clamp(y + dy, 0, plane.height - 1))[std::clamp(x + dx, 0, plane.width - 1)];
  return out;
}

}  // namespace

void despike(Plane& plane, float threshold) {
  Plane unlike(plane.width, plane.height);
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      std::array<float, 8> d = neighbours(plane, x, y);
      for (float& value : d) value = std::fabs(value - plane.row(y)[x]);
      std::nth_element(d.begin(), d.begin() + 3, d.end());
      unlike.row(y)[x] = d[0] + d[1] + d[2] + d[3];
    }
  const float limit = std::max(threshold, 4 * median(unlike.values));
  const Plane source = plane;
  for (int y = 0; y < plane.height; ++y)
    for (int x = 0; x < plane.width; ++x) {
      if (unlike.row(y)[x] <= limit) continue;
      // Of the neighbours that are not wild themselves, where there are some.
      std::array<float, 8> values = neighbours(source, x, y);
      const std::array<float, 8> wild = neighbours(unlike, x, y);
      std::size_t count = 0;
      for (std::size_t i = 0; i < 8; ++i)
        if (wild[i] <= limit) values[count++] = values[i];
      if (count == 0) count = 8;
      std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count / 2),
                       values.begin() + static_cast<std::ptrdiff_t>(count));
      plane.row(y)[x] = values[count / 2];
    }
}

}  // namespace face::flow
