// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/table.h"
#include "nodes/types/vertex_mask.h"

namespace face::evaluate {

struct CorrespondenceOptions {
  double full_scale_mm = 5;  // of the heat map
};

struct CorrespondenceResult {
  Table table;                    // a row per region: mean_mm, median_mm, p95_mm, max_mm, vertices
  RigidMotion truth_from_points;  // that was taken out
  Image heat_map;
};

// Per-vertex correspondence error: points are laid over the truth by a rotation and a translation without scale
// (Umeyama, Least-Squares Estimation of Transformation Parameters Between Two Point Patterns, PAMI 1991, eqs. 38-43)
// that fits the vertices which the jaw leaves alone; what is left of |x_i - y_i| is told per region. A distance to the
// nearest surface could not see vertices that slide. rigid: the vertices to lay over each other; null =
// jaw_free_vertices(rig); at least 3 not on a line. points, truth: V x 3, V as the rig's.
CorrespondenceResult correspondence(const Rig& rig, const MeshPoints& points, const MeshPoints& truth,
                                    const VertexMask* rigid, const CorrespondenceOptions& options = {});

}  // namespace face::evaluate
