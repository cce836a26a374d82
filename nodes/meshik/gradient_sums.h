// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "nodes/meshik/blend_tile.h"

namespace face::meshik {

// x += G' m for the gradients m of one tile (what they do to the two unit vectors). x: (free_count + 1) x 4 in the
// factor's order; pinned vertices add to the last row, which nobody reads.
void add_gradients(const MeshSpace& space, std::size_t tile, const TileVectors& gradients, double* x);

// G v - M q of a tile whose blend M q is `blended`, at the vertices v (x, y, z of each); 0 in lanes that hold no
// triangle. Returns the sum of its squares.
double residual_of(const MeshSpace& space, std::size_t tile, const TileVectors& blended, const std::vector<double>& v,
                   TileVectors& residual);

// From the factor's order to that of the mesh: x, y, z of every vertex, pinned ones at 0.
std::vector<double> unpack_vertices(const MeshSpace& space, const std::vector<double>& x);

// Moves every part along each axis by what `shift` says (x, y, z of every part); where it says nothing, so that the
// part's centroid is where a linear blend of the examples has it.
void move_parts(const MeshSpace& space, const std::vector<double>& weights,
                const std::vector<std::optional<double>>& shift, std::vector<double>& vertices_mm);

// How many parts the mesh falls into.
std::size_t part_count(const MeshSpace& space);

}  // namespace face::meshik
