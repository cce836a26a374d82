// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <numbers>

#include "nodes/types/arkit.h"
#include "nodes/types/rig.h"

namespace test {

// A ball about the origin, of quads and two caps, that runs counter-clockwise seen from outside.
inline face::Mesh ball(float radius_mm, std::uint32_t around = 96, std::uint32_t rows = 48) {
  face::Mesh mesh;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double polar = std::numbers::pi * j / rows, angle = 2 * std::numbers::pi * i / around;
      mesh.points_mm.push_back({static_cast<float>(radius_mm * std::sin(polar) * std::sin(angle)),
                                static_cast<float>(radius_mm * std::cos(polar)),
                                static_cast<float>(radius_mm * std::sin(polar) * std::cos(angle))});
    }
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t next = (i + 1) % around;
      mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
      for (const std::uint32_t v : {j * around + i, (j + 1) * around + i, (j + 1) * around + next, j * around + next})
        mesh.corners.push_back(v);
    }
  mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  return mesh;
}

// A ball whose jawOpen moves all of it 30 mm down.
inline face::Rig ball_rig(float radius_mm) {
  face::Rig rig;
  rig.neutral = ball(radius_mm);
  for (const std::string_view name : face::arkit_names) rig.shapes.push_back({std::string(name), {}, {}});
  face::Shape& jaw = rig.shapes[face::arkit_index("jawOpen")];
  for (std::uint32_t v = 0; v < rig.neutral.points_mm.size(); ++v) {
    jaw.vertices.push_back(v);
    jaw.offsets_mm.push_back({0, -30, 0});
  }
  return rig;
}

}  // namespace test
