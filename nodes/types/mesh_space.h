// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

namespace face {

// Example poses of a mesh, taken apart so that they can be blended by rotations and stretches (meshik), with the
// factor of the system that turns a blend back into vertices. V vertices, F triangles, K examples, C connected parts.
// Made by meshik::prepare, which says what is where; nobody else fills it in.
struct MeshSpace {
  std::uint64_t vertex_count = 0;
  std::uint64_t example_count = 0;
  std::vector<std::uint32_t> triangles;  // 3 F, those whose area is not 0; first those that an example changes
  std::vector<double> frames;            // 6 x F: two unit vectors that span every triangle of the reference
  std::vector<double> gradients;         // 4 x F: of vertices 1 and 2's hat functions along them
  std::vector<double> blends;            // K x 9 x those: rotation vector, (stretch - I) times each of the two vectors

  std::vector<std::uint32_t> component;  // V: connected part of every vertex
  std::vector<double> centroids_mm;      // (K + 1) x C x 3: of the reference, then of the examples minus it

  std::vector<std::uint32_t> order;          // V: place of a vertex in the factor; V where it is pinned
  std::vector<std::uint32_t> column_starts;  // lower triangular factor L of G'G by columns, diagonal first
  std::vector<std::uint32_t> rows;
  std::vector<double> values;
};

}  // namespace face
