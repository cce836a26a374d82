// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/matrix.h"
#include "nodes/types/table.h"

namespace face::cluster {

struct MergeOptions {
  std::int64_t groups = 0;  // how many to keep; 0 finds the knee of the error
  double max_distance = 0;  // exemplars nearer than this are merged whatever the error; 0: none
};

struct MergeResult {
  Matrix labels;     // N x 1
  Matrix exemplars;  // K x 1, ascending
  Table curve;       // groups, distance_merged, error: row g is with g groups; rows named by it
  std::int64_t knee = 0;
};

// Merges the two groups whose exemplars are nearest to each other, again and again (Animating Lip-Sync Speech Faces,
// section 5.3 and Fig. 7): the larger group's exemplar stays. The error of every count is the root mean square of what
// non-negative weights of the exemplars (Eq 5), relative to neutral, do not explain of the points.
// More than 63 groups are merged down to 63 before any is judged.
// The knee, which the paper finds by eye: the smallest count whose error is below a tenth of the way from the least
// error to that of one group, plus none where the curve is flat.
// points: N x D, labels: N x 1, exemplars: K x 1, as from affinity_propagation. neutral: D numbers, null: the mean.
MergeResult merge(const Matrix& points, const Matrix& labels, const Matrix& exemplars, const Matrix* neutral,
                  const MergeOptions& options = {});

}  // namespace face::cluster
