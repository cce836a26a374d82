// SPDX-License-Identifier: Apache-2.0
// A small stand-in for a face with a mouth, of which everything is known.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "nodes/types/mesh.h"

namespace test {

constexpr int sheet_columns = 41, sheet_rows = 41;
constexpr int sheet_upper_lip = 20;                             // row; the lower lip is the one below it
constexpr int sheet_right_corner = 11, sheet_left_corner = 29;  // columns between which the lips are apart

inline std::uint32_t sheet_vertex(int row, int column) {
  return static_cast<std::uint32_t>(row * sheet_columns + column);
}

// A sheet of squares of 2 mm on a cylinder about the y axis, with an opening 18 squares wide in its middle. gap_mm: how
// much farther than one square the lips are apart. Rows go down, columns from the right of the face to its left; uvs
// are the pixels of a picture of 41 x 41.
inline face::Mesh lip_sheet(double gap_mm, double radius_mm = 90, bool open = true) {
  face::Mesh mesh;
  for (int r = 0; r < sheet_rows; ++r)
    for (int c = 0; c < sheet_columns; ++c) {
      const double phi = (c - 20) * 2.0 / 90;
      // Rows 0 to 20 are above the opening, 21 to 40 below it; its corners stay together.
      const double wide = std::max(0.0, 1 - std::pow((c - 20) / 9.0, 2)),
                   near = std::max(0.0, 1 - std::abs(r - 20.5) / 12);
      const double y = (20 - r) * 2.0 + (r <= sheet_upper_lip ? 0.5 : -0.5) * gap_mm * wide * near;
      mesh.points_mm.push_back({static_cast<float>(radius_mm * std::sin(phi)), static_cast<float>(y),
                                static_cast<float>(radius_mm * std::cos(phi))});
      mesh.colors_srgb.push_back({0.5f, 0.5f, 0.5f});
      mesh.uvs.push_back(
          {(static_cast<float>(c) + 0.5f) / sheet_columns, 1 - (static_cast<float>(r) + 0.5f) / sheet_rows});
    }
  mesh.polygon_starts = {0};
  for (int r = 0; r + 1 < sheet_rows; ++r)
    for (int c = 0; c + 1 < sheet_columns; ++c) {
      if (open && r == sheet_upper_lip && c >= sheet_right_corner && c < sheet_left_corner) continue;
      for (const auto& [dr, dc] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        mesh.corners.push_back(sheet_vertex(r + dr, c + dc));
      mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
  return mesh;
}

}  // namespace test
