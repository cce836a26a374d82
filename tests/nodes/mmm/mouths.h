// SPDX-License-Identifier: Apache-2.0
// Painted mouths for tests: skin with pores, lips about an opening of a given height, teeth in it.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/types/image.h"

namespace test {

// open: 0 to 1; wide: about 1. 96 x 64 pixels.
inline face::Image painted_mouth(double open, double wide) {
  face::Image image{96, 64, 3, {}};
  const auto edge = [](double d) { return std::clamp(d / 2 + 0.5, 0.0, 1.0); };  // two pixels from one to the other
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      // The skin goes with the lips, less so farther away.
      const double dx = (x - 47.5) / wide, away = std::exp(-std::pow((x - 47.5) / 32, 4));
      const double dy = y - 30.0, gap = 1 + 10 * open * std::max(0.0, 1 - dx * dx / 700);
      const double shift = away * (dy > 0 ? gap : -0.4 * gap) * std::exp(-dy * dy / 800);
      const double v = dy - shift;
      const double pores = 10 * std::sin(0.9 * dx) * std::sin(0.8 * v) + 6 * std::sin(0.33 * dx + 0.5 * v);
      const double outer = 9 * (1 - dx * dx / 700);
      const double lips = edge(outer - std::abs(v)),
                   inner = edge(gap - 1.5 - std::abs(dy - 0.3 * gap)) * edge(24 - std::abs(dx));
      const double skin[3] = {205 + pores, 160 + pores, 135 + pores}, red[3] = {175 + pores, 80 + pores, 85 + pores};
      for (int c = 0; c < 3; ++c) {
        const double mouth = dy < 0 ? 190 - 20.0 * c : 60 - 10.0 * c;
        const double value = (1 - inner) * ((1 - lips) * skin[c] + lips * red[c]) + inner * mouth;
        image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)));
      }
    }
  return image;
}

}  // namespace test
