// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/table.h"

namespace face::evaluate {

struct MeshDifferenceResult {
  Table table;    // row "all": how far the vertices of a are from those of b
  Image picture;  // a, b and the distances in colours on a; empty where there is nothing to draw
};

// Two meshes beside each other, in mm, as they stand: nothing is aligned. Vertex by vertex where both have as many
// (matched = 1), else from each vertex of a to the nearest of b. The first column, mean_mm, tells how far apart they
// are.
MeshDifferenceResult mesh_difference(const Mesh& a, const Mesh& b);

// The same for vertices without their mesh: row "all" alone.
Table points_difference(const MeshPoints& a, const MeshPoints& b);

}  // namespace face::evaluate
