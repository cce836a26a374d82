// SPDX-License-Identifier: Apache-2.0
// The collapses of meshik.simplify. OpenMesh stays out of the header.
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/types/vec.h"

namespace face::meshik {

// What is collapsed: triangles, and where the vertices are in every pose (the first is the reference).
struct CollapseSet {
  std::vector<std::uint32_t> triangles;      // 3 F
  std::vector<std::vector<Vec3f>> poses_mm;  // P x V
  std::vector<double> importance;            // V; multiplies the cost of taking a vertex away
  std::vector<std::uint8_t> keep;            // V; 1 = is never taken away
};

struct Collapsed {
  std::vector<std::uint32_t> triangles;  // 3 F', of the same vertices
  std::vector<std::uint32_t> faces;      // F', which of the given triangles each was; ascending
};

// Takes vertices away until no more than `vertices` are in use, by collapses of an edge into one of its ends (Garland
// and Heckbert, Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997), the same for all poses: the cost of
// a collapse is the sum over the poses of the quadric error, by importance. So every vertex that is left is one of the
// given ones, in all poses, and nothing slides. Borders are held by quadrics across them (their section 6). A collapse
// that turns a triangle by more than 60 degrees in any pose is not made. Triangles that do not belong to a surface
// (more than two at an edge, or fans that meet in a vertex alone) stay as they are. Stops early where nothing is left
// to collapse.
Collapsed collapse_set(const CollapseSet& set, std::size_t vertices);

}  // namespace face::meshik
