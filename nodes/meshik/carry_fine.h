// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/matrix.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/mesh_space.h"
#include "nodes/types/weights.h"

namespace face::meshik {

// A frame that MeshIK has solved on a simplified head, on the whole one: the blend of the whole head's examples at the
// same weights (Eq 2 of Animating Lip-Sync Speech Faces), and upon it what the constraints have moved the simplified
// head's vertices beyond its own blend, spread over the surface between them. So the detail is that of the examples,
// and parts that are rigid in them stay so.
// space, simple_space: of the whole and of the simplified examples (meshik::prepare), in the same order. binding: from
// meshik::simplify. weights, points: of the frame; both empty (a frame that was lost) give no points.
MeshPoints carry_fine(const MeshSpace& space, const MeshSpace& simple_space, const Matrix& binding,
                      const Weights& weights, const MeshPoints& points);

}  // namespace face::meshik
