// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/nnls.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/nnls.h"
#include "nodes/weights/relative_basis.h"

namespace face::weights {

NnlsResult nnls(const Matrix& basis, const Matrix& targets, const Matrix* neutral, const NnlsOptions& options) {
  check_problem(basis, targets, neutral);
  if (neutral != nullptr)
    return nnls(relative_basis(basis, *neutral), relative_targets(targets, *neutral), nullptr, options);
  NonNegativeLeastSquares solver(basis, options.sum_to_one);
  NnlsResult result;
  result.weights = {targets.rows, basis.columns, std::vector<double>(targets.rows * basis.columns)};
  double squares = 0;
  for (std::size_t n = 0; n < targets.rows; ++n) {
    const double* target = &targets.values[n * targets.columns];
    double* weights = &result.weights.values[n * basis.columns];
    result.kkt_residual = std::max(result.kkt_residual, solver.solve(target, weights));
    for (std::size_t m = 0; m < basis.rows; ++m) {
      double rest = target[m];
      for (std::size_t k = 0; k < basis.columns; ++k) rest -= basis.at(m, k) * weights[k];
      squares += rest * rest;
    }
  }
  if (!targets.values.empty()) result.rms = std::sqrt(squares / static_cast<double>(targets.values.size()));
  return result;
}

}  // namespace face::weights
