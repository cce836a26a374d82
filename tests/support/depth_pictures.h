// SPDX-License-Identifier: Apache-2.0
// Pictures of a recorded stream of scans, as decode.depth_take reads them.
#pragma once
#include <cmath>
#include <string>
#include <vector>

namespace test {

constexpr int depth_width = 64, depth_height = 48;

// Its camera; depths are tenths of a mm.
constexpr const char* depth_camera_json =
    R"({"fx": 200, "fy": 200, "cx": 31.5, "cy": 23.5, "width": 64, "height": 48, "depth_unit_mm": 0.1, "rate_hz": 40})";

// A grey picture as PGM, of 8 or 16 bits.
inline std::string pgm(const std::vector<int>& values, int most, int columns = depth_width) {
  std::string out = "P5\n" + std::to_string(columns) + " " + std::to_string(static_cast<int>(values.size()) / columns) +
                    "\n" + std::to_string(most) + "\n";
  for (const int v : values) {
    if (most > 255) out += static_cast<char>(v / 256);
    out += static_cast<char>(v % 256);
  }
  return out;
}

// A ball of 80 mm before the camera, in tenths of a mm; nothing beside it, or right of a column.
inline std::vector<int> ball(int distance_mm = 900, int until_column = depth_width) {
  std::vector<int> depth(depth_width * depth_height, 0);
  for (int y = 0; y < depth_height; ++y)
    for (int x = 0; x < until_column; ++x) {
      const double dx = (x - 31.5) * distance_mm / 200, dy = (y - 23.5) * distance_mm / 200,
                   left = 80 * 80 - dx * dx - dy * dy;
      if (left > 0)
        depth[static_cast<std::size_t>(y * depth_width + x)] = static_cast<int>(10 * (distance_mm - std::sqrt(left)));
    }
  return depth;
}

}  // namespace test
