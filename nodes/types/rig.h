// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "nodes/types/mesh.h"

namespace face {

// A blend shape: offsets of the vertices that it moves, at weight 1. An empty shape moves nothing.
struct Shape {
  std::string name;
  std::vector<std::uint32_t> vertices;  // ascending
  std::vector<Vec3f> offsets_mm;        // as many
};

// Two vertices that meet when the mouth is closed.
struct LipPair {
  std::uint32_t upper = 0;
  std::uint32_t lower = 0;
};

// A head and its blend shapes. A pose is neutral + sum_s weight_s * shape_s.
// shapes[0..51] are the ARKit-52 in the order of arkit.h (a rig that lacks one has it empty and names it in `missing`);
// shapes of the rig's own follow.
struct Rig {
  Mesh neutral;
  std::vector<Shape> shapes;
  std::vector<std::string> missing;
  std::vector<LipPair> inner_lips;         // about the middle of the mouth, where closure is measured
  std::vector<std::uint32_t> lower_lip;    // vertices of the lower lip that may touch the upper teeth (labiodentals)
  std::vector<std::uint32_t> upper_teeth;  // vertices of the upper front teeth
  std::vector<std::uint32_t> landmarks68;  // Multi-PIE order; may be empty
};

}  // namespace face
