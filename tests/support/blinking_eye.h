// SPDX-License-Identifier: Apache-2.0
// A picture of an eye whose lids shut by any share, of which everything is known.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>

#include "nodes/base/srgb.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"

namespace test {

constexpr int eye_columns = 90, eye_rows = 80;
constexpr double eye_x = 45, eye_y = 40, eye_half_width = 14, eye_half_height = 6, lid_px = 8;

// Half the height of an eye's opening in a column.
inline double eye_opening(double x) {
  const double s = x / eye_half_width;
  return s * s < 1 ? eye_half_height * std::sqrt(1 - s * s) : 0;
}

// Lids that are open by a share q move what is above and below them. Where a place of the skin goes, above the middle.
inline double skin_to(double x, double y, double q) {
  const double b = eye_opening(x);
  return y - (1 - q) * b * std::max(0.0, 1 - (y - b) / lid_px);
}

inline double skin_grey(double x, double y) {
  return 120 + 12 * std::sin(0.5 * x) + 12 * std::cos(0.45 * y) + (y < 0 ? 10 : 0);
}
inline double eye_grey(double x, double y) { return std::hypot(x, y) < 4 ? 30 : 225; }

// What a place of a frame shows, x and y from the eye's middle.
inline double seen_grey(double x, double y, double q) {
  const double b = eye_opening(x), away = std::fabs(y);
  if (away < q * b) return eye_grey(x, y);
  double low = b, high = away + eye_half_height + 1;
  for (int i = 0; i < 40; ++i) {
    const double between = 0.5 * (low + high);
    (skin_to(x, between, q) < away ? low : high) = between;
  }
  return skin_grey(x, std::copysign(low, y));
}

// A pixel is 1 mm. Every pixel is the mean light of 16 places.
inline face::DepthScan eye_scan(double q) {
  face::DepthScan scan;
  scan.camera.focal_px = 200;
  scan.camera.position_mm = {0, 0, 200};
  scan.camera.centre_x_px = static_cast<float>(eye_x);
  scan.camera.centre_y_px = static_cast<float>(eye_y);
  scan.depth_mm.assign(static_cast<std::size_t>(eye_columns * eye_rows), 200);
  scan.picture = {eye_columns, eye_rows, 1, {}};
  for (int y = 0; y < eye_rows; ++y)
    for (int x = 0; x < eye_columns; ++x) {
      double light = 0;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          light += face::linear_of(seen_grey(x + (i - 1.5) / 4 - eye_x, y + (j - 1.5) / 4 - eye_y, q) / 255) / 16;
      scan.picture.pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * face::srgb_of(light))));
    }
  return scan;
}

// Its mesh, as of a reference scan: a vertex at every second pixel.
inline face::Mesh eye_mesh() {
  face::Mesh mesh;
  constexpr int columns = eye_columns / 2, rows = eye_rows / 2;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      mesh.points_mm.push_back({static_cast<float>(2 * c - eye_x), static_cast<float>(eye_y - 2 * r), 0});
      mesh.uvs.push_back(
          {(static_cast<float>(2 * c) + 0.5f) / eye_columns, 1 - (static_cast<float>(2 * r) + 0.5f) / eye_rows});
    }
  for (int r = 0; r + 1 < rows; ++r)
    for (int c = 0; c + 1 < columns; ++c) {
      const auto a = static_cast<std::uint32_t>(r * columns + c), d = a + columns;
      for (const std::uint32_t corner : {a, d, a + 1, a + 1, d, d + 1}) {
        if (mesh.corners.size() % 3 == 0)
          mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
        mesh.corners.push_back(corner);
      }
    }
  mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  mesh.corner_uvs = mesh.corners;
  mesh.parts = {{"face", 0, static_cast<std::uint32_t>(mesh.polygon_count()), {1, 1, 1}, 0, true}};
  return mesh;
}

// The mesh of the open eye in a frame whose lids it has open by a share.
inline face::MeshPoints eye_shape(const face::Mesh& mesh, double q) {
  face::MeshPoints shape{mesh.points_mm};
  for (face::Vec3f& p : shape.points_mm) {
    const auto x = static_cast<double>(p[0]), y = static_cast<double>(p[1]);
    const double b = eye_opening(x);
    p[1] = static_cast<float>(std::fabs(y) < b ? q * y : std::copysign(skin_to(x, std::fabs(y), q), y));
  }
  return shape;
}

inline face::Landmarks eye_outline() {
  face::Landmarks out;
  for (int i = 0; i < 64; ++i) {
    const double angle = 2 * std::numbers::pi * i / 64;
    out.points.push_back({"1." + std::to_string(i), eye_x + eye_half_width * std::cos(angle),
                          eye_y + eye_half_height * std::sin(angle), true});
  }
  return out;
}

}  // namespace test
