// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/matrix.h"

namespace face::cluster {

struct KMeansOptions {
  std::int64_t groups = 8;
  std::int64_t max_iterations = 100;
  std::int64_t seed = 1;
};

// How many groups a baseline made, and who is in them; as affinity_propagation's result.
struct KMeansResult {
  Matrix labels;     // N x 1
  Matrix exemplars;  // K x 1: the point nearest to every centre
  Matrix centres;    // K x D
  double error = 0;  // sum of squared distances to the centres
};

// k-means (Lloyd, Least Squares Quantization in PCM, 1982) from k-means++ seeds (Arthur and Vassilvitskii, SODA 2007).
// points: N x D, N >= groups.
KMeansResult k_means(const Matrix& points, const KMeansOptions& options = {});

}  // namespace face::cluster
