// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/matrix.h"

namespace face::weights {

struct LeastSquaresOptions {
  bool sum_to_one = false;
};

struct LeastSquaresResult {
  Matrix weights;    // N x K
  double rms = 0;    // of targets - weights basis', over all numbers
  bool full = true;  // false where the shapes depend on each other: then the shortest of the best weights
};

// Weights of any sign: min |basis w - target|^2 (Animating Lip-Sync Speech Faces, Eq 4), for comparison with nnls.h,
// whose arguments these are. It fits better and over-fits: large weights of opposite sign.
LeastSquaresResult least_squares(const Matrix& basis, const Matrix& targets, const Matrix* neutral,
                                 const LeastSquaresOptions& options = {});

}  // namespace face::weights
