// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nodes/types/mesh.h"

namespace face::texture {

// Lists of vertices, one for each vertex.
struct Neighbours {
  std::vector<std::uint32_t> starts;  // V + 1
  std::vector<std::uint32_t> vertices;
  std::span<const std::uint32_t> of(std::size_t v) const {
    return {vertices.data() + starts[v], vertices.data() + starts[v + 1]};
  }
};

// Of every vertex in `among` those of `among` that are at most so far from it, itself among them.
Neighbours vertices_within(const std::vector<Vec3f>& points_mm, const std::vector<bool>& among, float distance_mm);

// Of every vertex in `among` those of `among` at the other ends of its edges; what lies at the same place is one
// vertex.
Neighbours mesh_neighbours(const Mesh& mesh, const std::vector<bool>& among);

// The vertex on the other side of x = 0; -1 where none is within 3 mm, and outside `among`. V.
std::vector<std::int32_t> mirrored_vertices(const std::vector<Vec3f>& points_mm, const std::vector<bool>& among);

// Values that are held at some vertices, by 0 (free) to 1 (as it is).
struct HarmonicFill {
  std::vector<std::array<double, 3>> value;
  std::vector<double> held;
};

// Lets the values that are not held be the mean of their neighbours', pulled towards 0 by `rest` of a neighbour's
// weight: successive over-relaxation in the order of the vertices.
void fill_harmonically(const Neighbours& neighbours, double rest, HarmonicFill& fill);

}  // namespace face::texture
