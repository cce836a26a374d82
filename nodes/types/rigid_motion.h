// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

namespace face {

// A rotation and a translation: point_in_target = rotation * point_in_source + translation. Names say which frames
// (world_from_head).
struct RigidMotion {
  std::array<double, 9> rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // rows, determinant 1
  std::array<double, 3> translation_mm = {0, 0, 0};
};

}  // namespace face
