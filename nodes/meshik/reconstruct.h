// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/mesh_points.h"
#include "nodes/types/mesh_space.h"
#include "nodes/types/weights.h"

namespace face::meshik {

// Vertices whose gradients are nearest to the blend of the examples' (Animating Lip-Sync Speech Faces, Eq 2):
//   v = argmin |G v - M(a)|,  M_j(a) = exp(sum_i a_i log R_ij) (I + sum_i a_i (S_ij - I)).
// Differs from the paper, whose stretch is sum_i a_i S_ij: that makes sense for weights that add up to one alone and
// lets the mesh collapse at a = 0. Here a = 0 is the reference and a_i = 1 alone is example i.
// The gradients leave the place of each connected part open: its centroid goes where a linear blend has it.
// weights: K. Returns x, y, z of every vertex, mm.
std::vector<double> reconstruct_vertices(const MeshSpace& space, const std::vector<double>& weights);

// The same for one frame of a sequence. A shorter list of weights leaves the rest 0.
MeshPoints reconstruct(const MeshSpace& space, const Weights& weights);

}  // namespace face::meshik
