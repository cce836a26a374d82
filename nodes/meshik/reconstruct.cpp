// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/reconstruct.h"

#include <cmath>
#include <optional>

#include "nodes/base/check.h"
#include "nodes/meshik/blend_tile.h"
#include "nodes/meshik/factor_space.h"
#include "nodes/meshik/gradient_sums.h"
#include "nodes/meshik/mesh_triangles.h"

namespace face::meshik {

std::vector<double> reconstruct_vertices(const MeshSpace& space, const std::vector<double>& weights) {
  check(weights.size() == space.example_count, "there are ", weights.size(), " weights, expected ", space.example_count,
        ", one per example");
  for (const double weight : weights) check(std::isfinite(weight), "a weight is ", weight, ", expected finite numbers");
  std::vector<double> x(4 * (free_count(space) + 1), 0.0);
  BlendTile blend;
  for (std::size_t tile = 0; tile < moving_tile_count(space); ++tile) {
    blend_tile(space, tile, weights.data(), blend);
    add_gradients(space, tile, blend.blended, x.data());
  }
  for (std::size_t tile = moving_tile_count(space); tile < tile_count(space); ++tile)
    add_gradients(space, tile, frame_tile(space, tile), x.data());
  solve_lower(space, x.data());
  solve_transpose(space, x.data());
  std::vector<double> vertices = unpack_vertices(space, x);
  move_parts(space, weights, std::vector<std::optional<double>>(3 * part_count(space)), vertices);
  return vertices;
}

MeshPoints reconstruct(const MeshSpace& space, const Weights& weights) {
  check_space(space);
  std::vector<double> values(weights.values.begin(), weights.values.end());
  check(values.size() <= space.example_count, "there are ", values.size(), " weights, expected at most ",
        space.example_count, ", one per example");
  values.resize(space.example_count);
  return {points_of(reconstruct_vertices(space, values))};
}

}  // namespace face::meshik
