// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/vec.h"

namespace face {

// Where the pixels of a reference picture are in a target: reference pixel (x, y) is found at (x, y) + displacement.
// Rows from the top.
struct FlowField {
  int width = 0;
  int height = 0;
  std::vector<Vec2f> displacement_px;  // height x width
  std::vector<std::uint8_t> valid;     // height x width, 1 where the displacement is known, else 0
};

}  // namespace face
