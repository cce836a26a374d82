// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/image.h"

namespace face::evaluate {

using Colour = std::array<std::uint8_t, 3>;  // sRGB

inline constexpr Colour paper = {24, 26, 30}, ink = {240, 238, 232}, pale_ink = {150, 158, 168},
                        grid_ink = {58, 62, 70};

enum class Anchor { left, middle, right };

struct Place {
  double x_px = 0;
  double y_px = 0;
};

// An RGB picture to draw on. What lies outside is left out. The same calls, the same bits.
class Canvas {
 public:
  Canvas(int width_px, int height_px);
  void fill(int x_px, int y_px, int width_px, int height_px, const Colour& colour);
  void paste(const Image& rgb, int x_px, int y_px);
  void line(const Place& from, const Place& to, const Colour& colour, int thickness_px = 1);
  // The base line of the text is at y. Only ASCII is drawn; anything else becomes '?'. Returns its width in pixels.
  int text(const std::string& text, const Place& at, double capital_px, const Colour& colour,
           Anchor anchor = Anchor::left);
  const Image& image() const { return image_; }

 private:
  Image image_;
};

// A number as people write it: at most 4 digits, no trailing zeros, a point whatever the locale.
std::string short_number(double value);

// The five or so round numbers between low and high, for the ticks of an axis.
std::vector<double> ticks_between(double low, double high);

}  // namespace face::evaluate
