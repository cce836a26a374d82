// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "nodes/types/image.h"
#include "nodes/types/rig.h"
#include "nodes/types/table.h"
#include "nodes/types/vec.h"

namespace face::evaluate {

// How far the vertices of a are from those of b, in mm: vertex by vertex where they are as many (matched), else each to
// the nearest vertex of b. Vertices that are not finite in either are infinitely far. Empty where b has none.
struct VertexDistances {
  std::vector<double> mm;  // of every vertex of a
  bool matched = true;
};
VertexDistances vertex_distances(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b);

// mean_mm, rms_mm, p95_mm, largest_mm, moved_percent (vertices farther than 1 micrometre), vertices, matched (1 or 0).
inline const std::vector<std::string> distance_columns = {"mean_mm",       "rms_mm",   "p95_mm", "largest_mm",
                                                          "moved_percent", "vertices", "matched"};
std::vector<double> distance_values(const VertexDistances& distances);

// a and b as they are from the front, and a with its distances in colours (draw_heat_map); the scale ends at a round
// number of mm that only a hundredth of the vertices passes.
Image draw_distances(const Rig& a, const Rig& b, const std::vector<double>& distance_mm);

}  // namespace face::evaluate
