// SPDX-License-Identifier: Apache-2.0
// Pixels of a picture that are on or off, and what hangs together among them.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace face::transfer {

using Pixels = std::vector<std::array<int, 2>>;  // x, y

class PixelFlags {
 public:
  PixelFlags(int width, int height);
  int width() const { return width_; }
  int height() const { return height_; }
  // Off beside the picture.
  bool at(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_ && on_[index(x, y)] != 0; }
  void set(int x, int y, bool on) { on_[index(x, y)] = on ? 1 : 0; }
  // On where any pixel within a radius is.
  PixelFlags grown(int radius) const { return spread(radius, true); }
  // On where all pixels within a radius are; what is beside the picture is off.
  PixelFlags shrunk(int radius) const { return spread(radius, false); }

 private:
  PixelFlags spread(int radius, bool any) const;
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_, height_;
  std::vector<char> on_;
};

// What hangs together, corners included; in the order of their first pixels, row by row.
std::vector<Pixels> parts_of(PixelFlags flags);

// The outer border of a part, pixel by pixel, clockwise from its first in reading order (Moore's neighbours). A pixel
// that joins two halves comes once for each way through it.
Pixels border_of(const Pixels& part);

}  // namespace face::transfer
