// SPDX-License-Identifier: Apache-2.0
// A picture of a mouth that is open as far as one likes.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace test {

using Colour = std::array<std::uint8_t, 3>;
inline constexpr Colour skin{200, 150, 120}, upper_lip{150, 75, 70}, lower_lip{180, 95, 90}, hollow{40, 15, 12},
    tooth{215, 205, 175};

// A mouth from (20, 40) to (100, 40), each lip an ellipse's half of height 16, parted by a gap of a straight edge above
// and below the middle, in pixels.
struct DrawnMouth {
  double above = 0, below = 0;
  Colour inside = hollow;
  face::Image image() const {
    face::Image image{120, 80, 3, {}};
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double u = (x - 60) / 40.0, height = (16 + std::max(above, below)) * std::sqrt(std::max(0.0, 1 - u * u));
        const double v = y - 40;
        Colour colour = skin;
        if (std::abs(v) < height) colour = v < 0 ? upper_lip : lower_lip;
        if (std::abs(v) < height && v > -above && v < below) colour = inside;
        image.pixels.insert(image.pixels.end(), colour.begin(), colour.end());
      }
    return image;
  }
  face::Landmarks outer() const {
    face::Landmarks out;
    for (int i = 0; i < 12; ++i) {
      const double angle = i * std::acos(-1.0) / 6;
      out.points.push_back({"lip_" + std::to_string(i), 60 - 40 * std::cos(angle),
                            40 - (16 + std::max(above, below)) * std::sin(angle), true});
    }
    return out;
  }
};

// The same with a reflex of white light over the lower lip, and the upper one in the shade of what lights it.
inline face::Image glossy(const DrawnMouth& mouth) {
  face::Image image = mouth.image();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint8_t& value = image.pixels[static_cast<std::size_t>(y * image.width + x) * 3 + c];
        const double reflex = y > 46 && y < 53 ? 70 : 0, shade = y < 40 ? 0.6 : 1;
        value = static_cast<std::uint8_t>(std::min(255.0, shade * value + reflex));
      }
  return image;
}

}  // namespace test
