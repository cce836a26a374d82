// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/vec.h"

namespace face {

// Which point of a triangulated mesh every pixel of a picture shows: the truth beside a rendered picture.
struct SurfaceMap {
  int width = 0;
  int height = 0;
  std::vector<std::int32_t> triangle;  // height x width, index into the mesh's fan triangulation; -1 = background
  std::vector<Vec2f> weights;          // height x width: of the triangle's first two corners; the third has the rest
};

}  // namespace face
