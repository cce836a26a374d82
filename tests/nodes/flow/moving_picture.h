// SPDX-License-Identifier: Apache-2.0
// Pictures whose motion is known: a smooth random pattern, sampled where a motion says.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "nodes/base/random.h"
#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"

namespace test {

// A sum of waves about 6 to 40 pixels long, 20 to 235.
inline double pattern(double x, double y) {
  double sum = 0;
  face::Random random(3);
  for (int i = 0; i < 24; ++i) {
    const double angle = random.uniform(0, 6.2831853), length = 6 * std::pow(6.5, random.uniform());
    const double phase = random.uniform(0, 6.2831853), k = 6.2831853 / length;
    sum += std::sin(k * (std::cos(angle) * x + std::sin(angle) * y) + phase) * std::sqrt(length);
  }
  return std::clamp(127.5 + sum * 4, 20.0, 235.0);
}

using Motion = std::function<face::Vec2f(double, double)>;  // displacement of a reference pixel, affine at most

// reference(x, y) = pattern; target(x + u, y + v) = pattern(x, y): for slowly varying motions target(x) is the pattern
// where the inverse motion says, found by iteration.
inline face::FeatureMap picture(int width, int height, const Motion& motion) {
  face::FeatureMap map{width, height, {"grey"}, {}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sx = x, sy = y;
      for (int i = 0; i < 8; ++i) {
        const face::Vec2f d = motion(sx, sy);
        sx = x - static_cast<double>(d[0]);
        sy = y - static_cast<double>(d[1]);
      }
      map.values.push_back(static_cast<float>(pattern(sx, sy)));
    }
  map.valid.assign(map.values.size(), 1);
  return map;
}

inline face::FeatureMap still(int width = 160, int height = 120) {
  return picture(width, height, [](double, double) { return face::Vec2f{0, 0}; });
}

// Mean length of the error over valid pixels at least `margin` from the border.
inline double mean_error_px(const face::FlowField& flow, const Motion& motion, int margin = 12) {
  double sum = 0, count = 0;
  for (int y = margin; y < flow.height - margin; ++y)
    for (int x = margin; x < flow.width - margin; ++x) {
      const auto i = static_cast<std::size_t>(y * flow.width + x);
      if (!flow.valid[i]) continue;
      const face::Vec2f d = motion(x, y);
      sum += std::hypot(static_cast<double>(flow.displacement_px[i][0] - d[0]),
                        static_cast<double>(flow.displacement_px[i][1] - d[1]));
      ++count;
    }
  return count > 0 ? sum / count : 1e9;
}

}  // namespace test
