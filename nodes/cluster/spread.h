// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/matrix.h"

namespace face::cluster {

struct SpreadOptions {
  std::int64_t axes = 4;  // principal components whose ends are taken
};

struct SpreadResult {
  Matrix labels;     // N x 1: nearest exemplar
  Matrix exemplars;  // at most 2 axes x 1, ascending
};

// The points at both ends of the leading principal components: maximum spread (Chuang and Bregler, Moodswings:
// Expressive Speech Animation, ACM TOG 24, 2005), for comparison. A point that is at two ends counts once.
SpreadResult spread(const Matrix& points, const SpreadOptions& options = {});

}  // namespace face::cluster
