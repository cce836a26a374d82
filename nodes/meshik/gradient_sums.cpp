// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/gradient_sums.h"

#include <algorithm>

#include "nodes/meshik/factor_space.h"

namespace face::meshik {

using Four [[gnu::vector_size(32), gnu::aligned(8)]] = double;
using Lanes [[gnu::vector_size(64), gnu::aligned(8)]] = double;

void add_gradients(const MeshSpace& space, std::size_t tile, const TileVectors& gradients, double* x) {
  Four* const sums = reinterpret_cast<Four*>(x);
  const std::size_t last = free_count(space), triangles = space.triangles.size() / 3;
  const std::size_t lanes = std::min(tile_lanes, triangles - tile * tile_lanes);
  const double* g = &space.gradients[tile * 4 * tile_lanes];
  for (std::size_t l = 0; l < lanes; ++l) {
    const Four first = {gradients[0][0][l], gradients[0][1][l], gradients[0][2][l], 0};
    const Four second = {gradients[1][0][l], gradients[1][1][l], gradients[1][2][l], 0};
    const Four one = g[l] * first + g[tile_lanes + l] * second;
    const Four two = g[2 * tile_lanes + l] * first + g[3 * tile_lanes + l] * second;
    const std::uint32_t* corner = &space.triangles[3 * (tile * tile_lanes + l)];
    const auto place = [&](std::uint32_t v) { return std::min<std::size_t>(space.order[v], last); };
    sums[place(corner[0])] -= one + two;
    sums[place(corner[1])] += one;
    sums[place(corner[2])] += two;
  }
}

double residual_of(const MeshSpace& space, std::size_t tile, const TileVectors& blended, const std::vector<double>& v,
                   TileVectors& residual) {
  double edges[2][3][tile_lanes] = {};
  const std::size_t lanes = std::min(tile_lanes, space.triangles.size() / 3 - tile * tile_lanes);
  for (std::size_t l = 0; l < lanes; ++l) {
    const std::uint32_t* corner = &space.triangles[3 * (tile * tile_lanes + l)];
    for (std::size_t e = 0; e < 2; ++e)
      for (std::size_t d = 0; d < 3; ++d) edges[e][d][l] = v[3 * corner[1 + e] + d] - v[3 * corner[0] + d];
  }
  const auto eight = [](const double* from) -> const Lanes& { return *reinterpret_cast<const Lanes*>(from); };
  const double* g = &space.gradients[tile * 4 * tile_lanes];
  Lanes squares = {};
  for (std::size_t q = 0; q < 2; ++q)
    for (std::size_t d = 0; d < 3; ++d) {
      const Lanes value = eight(g + q * tile_lanes) * eight(edges[0][d]) +
                          eight(g + (2 + q) * tile_lanes) * eight(edges[1][d]) - eight(blended[q][d]);
      *reinterpret_cast<Lanes*>(residual[q][d]) = value;
      squares += value * value;
    }
  double energy = 0;
  for (std::size_t l = 0; l < tile_lanes; ++l) energy += squares[l];
  return energy;
}

std::vector<double> unpack_vertices(const MeshSpace& space, const std::vector<double>& x) {
  const std::size_t count = free_count(space);
  std::vector<double> vertices(3 * static_cast<std::size_t>(space.vertex_count), 0.0);
  for (std::size_t v = 0; v < space.order.size(); ++v)
    if (space.order[v] < count)
      for (std::size_t d = 0; d < 3; ++d) vertices[3 * v + d] = x[4 * space.order[v] + d];
  return vertices;
}

std::size_t part_count(const MeshSpace& space) {
  return space.centroids_mm.size() / 3 / (1 + static_cast<std::size_t>(space.example_count));
}

void move_parts(const MeshSpace& space, const std::vector<double>& weights,
                const std::vector<std::optional<double>>& shift, std::vector<double>& vertices_mm) {
  const std::size_t size = 3 * part_count(space);
  std::vector<double> sums(size, 0.0), counts(size / 3, 0.0), moves(size);
  for (std::size_t v = 0; v < space.component.size(); ++v) {
    counts[space.component[v]] += 1;
    for (std::size_t d = 0; d < 3; ++d) sums[3 * space.component[v] + d] += vertices_mm[3 * v + d];
  }
  for (std::size_t i = 0; i < size; ++i) {
    double centroid = space.centroids_mm[i];
    for (std::size_t k = 0; k < weights.size(); ++k) centroid += weights[k] * space.centroids_mm[(k + 1) * size + i];
    moves[i] = shift[i] ? *shift[i] : centroid - sums[i] / counts[i / 3];
  }
  for (std::size_t v = 0; v < space.component.size(); ++v)
    for (std::size_t d = 0; d < 3; ++d) vertices_mm[3 * v + d] += moves[3 * space.component[v] + d];
}

}  // namespace face::meshik
