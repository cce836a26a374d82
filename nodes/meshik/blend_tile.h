// SPDX-License-Identifier: Apache-2.0
// How MeshSpace lies in memory, and the blend of its triangles, eight at a time. `frames`, `gradients` and `blends` are
// tile after tile of eight triangles (the last one filled up with zeros), within a tile the quantities of the type's
// comments, and eight numbers of each.
#pragma once
#include <cstddef>

#include "nodes/types/mesh_space.h"

namespace face::meshik {

constexpr std::size_t tile_lanes = 8;

inline std::size_t tile_count(const MeshSpace& space) {
  return (space.triangles.size() / 3 + tile_lanes - 1) / tile_lanes;
}

// Tiles with a triangle that some example changes come first; `blends` has these alone.
inline std::size_t moving_tile_count(const MeshSpace& space) {
  const std::size_t numbers = 9 * tile_lanes * static_cast<std::size_t>(space.example_count);
  return numbers == 0 ? 0 : space.blends.size() / numbers;
}

// Gradient of each vertex's hat function (1 there, 0 at the other two) along the triangle's two unit vectors, 1/mm.
struct HatGradients {
  double along[3][2];
};
inline HatGradients hat_gradients(const MeshSpace& space, std::size_t triangle) {
  const double* g = &space.gradients[triangle / tile_lanes * 4 * tile_lanes + triangle % tile_lanes];
  const double a = g[0], b = g[tile_lanes], c = g[2 * tile_lanes], d = g[3 * tile_lanes];
  return {{{-a - c, -b - d}, {a, b}, {c, d}}};
}

// The two unit vectors of eight triangles, which is what the blend leaves of them where no example changes them.
using TileVectors = double[2][3][tile_lanes];
inline const TileVectors& frame_tile(const MeshSpace& space, std::size_t tile) {
  return reinterpret_cast<const TileVectors&>(space.frames[tile * 6 * tile_lanes]);
}

// M(F; a) of eight triangles that some example changes, by what it does to their two unit vectors.
struct BlendTile {
  double rotation[3][tile_lanes];      // w = sum_i a_i log R_i
  double stretched[2][3][tile_lanes];  // (I + sum_i a_i (S_i - I)) q
  double blended[2][3][tile_lanes];    // exp[w]x times it
  double sine[tile_lanes];             // sin |w| / |w|
  double cosine[tile_lanes];           // (1 - cos |w|) / |w|^2
};
void blend_tile(const MeshSpace& space, std::size_t tile, const double* weights, BlendTile& blend);

}  // namespace face::meshik
