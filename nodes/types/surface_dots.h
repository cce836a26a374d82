// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/vec.h"

namespace face {

// A round spot on the skin: a marker, a mole, a freckle. It is painted over the vertex colours of a mesh, at any
// resolution: a point at the distance d (mm, straight through space in the pose at hand) from the dot's centre takes
// the dot's colour by opacity * (1 - smooth_step(radius_mm - 0.5 edge_mm, radius_mm + 0.5 edge_mm, d)); surfaces of
// other parts (teeth, tongue, eyes) are not painted.
struct SurfaceDot {
  std::string name;                                   // "marker_12", "mole", "freckle"
  std::array<std::uint32_t, 3> vertices = {0, 0, 0};  // corners of the triangle that it lies on
  Vec3f weights = {1, 0, 0};                          // of these corners; they sum to 1
  float radius_mm = 1;
  float edge_mm = 0.3f;  // width over which it fades out
  Vec3f color_srgb = {0, 0, 0};
  float opacity = 1;
};

// Dots of one mesh; later ones lie over earlier ones.
struct SurfaceDots {
  std::vector<SurfaceDot> dots;
};

}  // namespace face
