// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/vec.h"

namespace face {

// Where the vertices of a mesh are in one frame; the polygons are those of the mesh that it belongs to.
struct MeshPoints {
  std::vector<Vec3f> points_mm;  // V
};

}  // namespace face
