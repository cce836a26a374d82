// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/meshik/blend_tile.h"

namespace face::meshik {

// d (M(a) q) / d a_k of eight triangles and their two unit vectors: exact, by the left Jacobian of the rotation group
//   d/da_k exp[w]x p = [J(w) w_k]x exp[w]x p + exp[w]x d_k.
// derivative: 2 x 3 x 8 for example k.
void blend_derivative(const MeshSpace& space, std::size_t tile, std::size_t k, const BlendTile& blend,
                      TileVectors& derivative);

// gradient_k += sum over the tile of (d M q / d a_k) . residual, for all examples at once.
void add_blend_gradient(const MeshSpace& space, std::size_t tile, const BlendTile& blend, const TileVectors& residual,
                        double* gradient);

}  // namespace face::meshik
