// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

#include "nodes/meshik/blend_tile.h"

namespace face::meshik {

// x += G' m for the gradients m of one tile (what they do to the two unit vectors). x: (free_count + 1) x 4 in the
// factor's order; pinned vertices add to the last row, which nobody reads.
void add_gradients(const MeshSpace& space, std::size_t tile, const double (&gradients)[2][3][tile_lanes], double* x);

// From the factor's order to that of the mesh: x, y, z of every vertex, pinned ones at 0.
std::vector<double> unpack_vertices(const MeshSpace& space, const std::vector<double>& x);

// Moves every part so that its centroid is where a linear blend of the examples has it, along the axes asked for;
// `placed` (one flag per part, or empty) names parts that stay.
void move_centroids(const MeshSpace& space, const std::vector<double>& weights, std::array<bool, 3> axes,
                    const std::vector<bool>& placed, std::vector<double>& vertices_mm);

}  // namespace face::meshik
