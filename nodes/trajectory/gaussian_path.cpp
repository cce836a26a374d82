// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/gaussian_path.h"

#include <cmath>

#include "nodes/base/check.h"
#include "nodes/trajectory/gaussian_trajectory.h"

namespace face::trajectory {

Matrix gaussian_path(const Matrix& means, const Matrix& variances, const GaussianPathOptions& options) {
  for (const Matrix* matrix : {&means, &variances})
    check(matrix->values.size() == matrix->rows * matrix->columns, matrix == &means ? "means" : "variances", " has ",
          matrix->values.size(), " values, expected ", matrix->rows, " x ", matrix->columns);
  check(means.rows == variances.rows && means.columns == variances.columns, "means is ", means.rows, " x ",
        means.columns, ", variances is ", variances.rows, " x ", variances.columns, ", expected the same shape");
  TrajectoryTargets targets{means.rows, means.columns, variances.values, means.values};
  for (std::size_t i = 0; i < targets.target.size(); ++i) {
    const std::size_t row = i / means.columns, column = i % means.columns;
    check(std::isfinite(targets.target[i]), "means holds ", targets.target[i], " in row ", row, " column ", column,
          ", expected finite numbers");
    check(targets.precision[i] > 0, "variances holds ", targets.precision[i], " in row ", row, " column ", column,
          ", expected more than 0");
    targets.precision[i] = 1 / targets.precision[i];
    check(std::isfinite(targets.precision[i] * targets.target[i]), "variances holds ", variances.values[i], " in row ",
          row, " column ", column, ", expected more: it is so small that its inverse is beyond all numbers");
  }
  return {means.rows, means.columns, solve_trajectory(targets, options.smoothness)};
}

}  // namespace face::trajectory
