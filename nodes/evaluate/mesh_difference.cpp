// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/mesh_difference.h"

#include "nodes/evaluate/statistics.h"
#include "nodes/evaluate/vertex_distances.h"

namespace face::evaluate {

MeshDifferenceResult mesh_difference(const Mesh& a, const Mesh& b) {
  const VertexDistances distances = vertex_distances(a.points_mm, b.points_mm);
  Rig first, second;
  first.neutral = a;
  second.neutral = b;
  return {one_row("all", distance_columns, distance_values(distances)), draw_distances(first, second, distances.mm)};
}

Table points_difference(const MeshPoints& a, const MeshPoints& b) {
  return one_row("all", distance_columns, distance_values(vertex_distances(a.points_mm, b.points_mm)));
}

}  // namespace face::evaluate
