// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/matrix.h"

namespace face::weights {

struct NnlsOptions {
  bool sum_to_one = false;
};

struct NnlsResult {
  Matrix weights;           // N x K
  double kkt_residual = 0;  // largest violation of the optimality conditions, relative (nodes/base/nnls.h)
  double rms = 0;           // of targets - weights basis', over all numbers
};

// Weights of every target over the same basis: min |basis w - target|^2, w >= 0 (Animating Lip-Sync Speech Faces, Eq
// 5). basis: M x K, targets: N x M, K <= 63. neutral (M numbers, may be null) is subtracted from every column of the
// basis and every target. Differs from the paper, which takes absolute positions: there the weights carry the place and
// the size of the whole face; relative to the neutral shape, or with a sum of one, they carry its expression.
NnlsResult nnls(const Matrix& basis, const Matrix& targets, const Matrix* neutral, const NnlsOptions& options = {});

}  // namespace face::weights
