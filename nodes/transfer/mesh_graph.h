// SPDX-License-Identifier: Apache-2.0
// Edges of a mesh, ways along them, and the edges at which it ends.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "nodes/types/mesh.h"
#include "nodes/types/vec.h"

namespace face::transfer {

// For every vertex its neighbours along polygon edges, ascending. polygons: which ones count; empty = all.
std::vector<std::vector<std::uint32_t>> neighbours_of(const Mesh& mesh, const std::vector<std::uint8_t>& polygons = {});

// Length of the shortest way along edges from any of the seeds, mm; infinite beyond reach_mm.
std::vector<float> distances_from(const std::vector<std::vector<std::uint32_t>>& neighbours,
                                  const std::vector<Vec3f>& points_mm, const std::vector<std::uint32_t>& seeds,
                                  float reach_mm);

// Edges that one polygon alone has, in its direction.
std::vector<std::pair<std::uint32_t, std::uint32_t>> open_edges(const Mesh& mesh);

// Continues values (three numbers per vertex) over a mesh from the vertices where known is set to all others: the
// nearest known values outwards, then means over neighbours until nothing changes much. Vertices that no way leads to
// get the mean of all known ones.
void spread_known(const std::vector<std::vector<std::uint32_t>>& neighbours, const std::vector<std::uint8_t>& known,
                  std::vector<Vec3f>& values);

}  // namespace face::transfer
