// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/matrix.h"

namespace face::cluster {

struct KeyShapesDirectOptions {
  std::int64_t groups = 8;
  std::int64_t rounds = 50;
  std::int64_t seed = 1;
};

struct KeyShapesDirectResult {
  Matrix labels;     // N x 1: the shape with the largest weight
  Matrix exemplars;  // K x 1: the point nearest to every shape
  Matrix shapes;     // K x D
  double error = 0;  // root mean square of what weights and shapes do not explain
};

// Minimises Eq 3 of Animating Lip-Sync Speech Faces, sum_j |f_j - sum_i w_ji S_i|^2 with w >= 0, over shapes and
// weights in turn (as semi-NMF: Ding, Li, Jordan, Convex and Semi-Nonnegative Matrix Factorizations, PAMI 32, 2010),
// from k-means++ seeds; relative to neutral (D numbers; null: the mean). For comparison: it finds shapes spaced evenly
// between open and closed and misses rare ones.
KeyShapesDirectResult key_shapes_direct(const Matrix& points, const Matrix* neutral,
                                        const KeyShapesDirectOptions& options = {});

}  // namespace face::cluster
