// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/pixel_parts.h"

#include <algorithm>
#include <utility>

namespace face::transfer {

PixelFlags::PixelFlags(int width, int height) : width_(width), height_(height) {
  on_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
}

PixelFlags PixelFlags::spread(int radius, bool any) const {
  PixelFlags out(width_, height_);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      bool found = !any;
      for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx)
          if (dx * dx + dy * dy <= radius * radius && at(x + dx, y + dy) == any) found = any;
      out.set(x, y, found);
    }
  return out;
}

std::vector<Pixels> parts_of(PixelFlags flags) {
  std::vector<Pixels> parts;
  for (int y = 0; y < flags.height(); ++y)
    for (int x = 0; x < flags.width(); ++x) {
      if (!flags.at(x, y)) continue;
      Pixels part = {{x, y}};
      flags.set(x, y, false);
      for (std::size_t next = 0; next < part.size(); ++next)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const int nx = part[next][0] + dx, ny = part[next][1] + dy;
            if (!flags.at(nx, ny)) continue;
            flags.set(nx, ny, false);
            part.push_back({nx, ny});
          }
      parts.push_back(std::move(part));
    }
  return parts;
}

Pixels border_of(const Pixels& part) {
  int width = 0, height = 0;
  for (const auto& [x, y] : part) width = std::max(width, x + 1), height = std::max(height, y + 1);
  PixelFlags flags(width, height);
  for (const auto& [x, y] : part) flags.set(x, y, true);
  constexpr std::array<std::array<int, 2>, 8> ways = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  // The first in reading order: there is nothing above and to its left.
  const auto [first_x, first_y] = *std::min_element(part.begin(), part.end(), [](const auto& a, const auto& b) {
    return std::pair(a[1], a[0]) < std::pair(b[1], b[0]);
  });
  Pixels border;
  int x = first_x, y = first_y;
  std::size_t way = 7;
  do {
    border.push_back({x, y});
    std::size_t turned = 0;
    for (; turned < 8; ++turned) {
      const auto& [dx, dy] = ways[(way + turned) % 8];
      if (flags.at(x + dx, y + dy)) break;
    }
    if (turned == 8) break;
    way = (way + turned) % 8;
    x += ways[way][0];
    y += ways[way][1];
    way = (way + 6) % 8;
  } while ((x != first_x || y != first_y) && border.size() < 4 * part.size());
  return border;
}

}  // namespace face::transfer
