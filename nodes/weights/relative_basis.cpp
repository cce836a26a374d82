// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/relative_basis.h"

#include <cmath>

#include "nodes/base/check.h"

namespace face::weights {
namespace {

void check_numbers(const Matrix& matrix, const char* name) {
  check(matrix.values.size() == matrix.rows * matrix.columns, name, " holds ", matrix.values.size(),
        " numbers, expected ", matrix.rows, " x ", matrix.columns);
  for (std::size_t i = 0; i < matrix.values.size(); ++i)
    if (!std::isfinite(matrix.values[i]))
      fail(name, " holds ", matrix.values[i], " in row ", i / matrix.columns, " column ", i % matrix.columns,
           ", expected finite numbers");
}

}  // namespace

void check_problem(const Matrix& basis, const Matrix& targets, const Matrix* neutral) {
  check_numbers(basis, "basis");
  check_numbers(targets, "targets");
  check(basis.rows == targets.columns, "targets has ", targets.columns, " columns, expected ", basis.rows,
        " as basis has rows");
  if (neutral == nullptr) return;
  check_numbers(*neutral, "neutral");
  check(neutral->values.size() == basis.rows, "neutral has ", neutral->values.size(), " numbers, expected ", basis.rows,
        " as basis has rows");
}

Matrix relative_basis(const Matrix& basis, const Matrix& neutral) {
  Matrix relative = basis;
  for (std::size_t m = 0; m < basis.rows; ++m)
    for (std::size_t k = 0; k < basis.columns; ++k) relative.at(m, k) -= neutral.values[m];
  return relative;
}

Matrix relative_targets(const Matrix& targets, const Matrix& neutral) {
  Matrix relative = targets;
  for (std::size_t n = 0; n < targets.rows; ++n)
    for (std::size_t m = 0; m < targets.columns; ++m) relative.at(n, m) -= neutral.values[m];
  return relative;
}

}  // namespace face::weights
