// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/weights.h"

namespace face::meshik {

// reference + sum_i weight_i (example_i - reference), vertex by vertex, for comparison with reconstruct: what turns
// shrinks on the way (Animating Lip-Sync Speech Faces, Fig. 1). A shorter list of weights leaves the rest 0.
MeshPoints blend_linear(const Mesh& reference, const engine::Seq<Mesh>& examples, const Weights& weights);

}  // namespace face::meshik
