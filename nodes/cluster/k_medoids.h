// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/matrix.h"

namespace face::cluster {

struct KMedoidsOptions {
  std::int64_t groups = 8;
  std::int64_t restarts = 10;
  std::int64_t seed = 1;
};

struct KMedoidsResult {
  Matrix labels;     // N x 1
  Matrix exemplars;  // K x 1, ascending
  double error = 0;  // sum of squared distances to the exemplars
};

// Like k-means, but centres are points (Park and Jun, A Simple and Fast Algorithm for K-Medoids Clustering, Expert
// Systems with Applications 36, 2009): the best of several runs from k-means++ seeds.
KMedoidsResult k_medoids(const Matrix& points, const KMedoidsOptions& options = {});

}  // namespace face::cluster
