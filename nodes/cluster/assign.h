// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/types/matrix.h"

namespace face::cluster {

// Which points stand for which: exemplars are points, in ascending order; labels are indices into exemplars.
struct Assignment {
  std::vector<std::size_t> exemplars;  // K
  std::vector<std::size_t> labels;     // N
};

// Throws where a number is not finite, or so large that its square overflows, or sizes do not fit; `name` is what
// messages call the matrix.
void check_points(const Matrix& points, const char* name);

double squared_distance(const Matrix& points, std::size_t a, std::size_t b);

// Every point with its nearest exemplar; exemplars with themselves. Sorts the exemplars. Ties go to the first.
Assignment assign(const Matrix& points, std::vector<std::size_t> exemplars);

// Of every group the point with the least sum of squared distances to the others, then assign() again. `rounds` times,
// or until nothing changes.
Assignment improve_medoids(const Matrix& points, Assignment assignment, std::size_t rounds);

// -(sum of squared distances of the points to their exemplars) + K preference: what affinity propagation maximises.
double net_similarity(const Matrix& points, const Assignment& assignment, double preference);

}  // namespace face::cluster
