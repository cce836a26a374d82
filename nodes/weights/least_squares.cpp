// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/least_squares.h"

#include <Eigen/Dense>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/weights/relative_basis.h"

namespace face::weights {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

LeastSquaresResult least_squares(const Matrix& basis, const Matrix& targets, const Matrix* neutral,
                                 const LeastSquaresOptions& options) {
  check_problem(basis, targets, neutral);
  if (neutral != nullptr)
    return least_squares(relative_basis(basis, *neutral), relative_targets(targets, *neutral), nullptr, options);
  check(basis.columns >= 1, "basis has no columns");
  const auto rows = static_cast<Eigen::Index>(basis.rows), columns = static_cast<Eigen::Index>(basis.columns);
  const Eigen::Map<const RowMatrix> b(basis.values.data(), rows, columns);
  const Eigen::Map<const RowMatrix> t(targets.values.data(), static_cast<Eigen::Index>(targets.rows), rows);
  RowMatrix w;
  LeastSquaresResult result;
  if (options.sum_to_one) {
    // w = 1/K + Z u with the columns of Z a basis of the vectors whose sum is 0.
    Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(columns, 1);
    const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(ones).householderQ();
    const Eigen::MatrixXd z = q.rightCols(columns - 1);
    const Eigen::VectorXd even = Eigen::VectorXd::Constant(columns, 1.0 / static_cast<double>(columns));
    w = even.transpose().replicate(t.rows(), 1);
    if (columns > 1) {
      const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(b * z);
      const Eigen::MatrixXd rest = (t - w * b.transpose()).transpose();
      w += (z * solver.solve(rest)).transpose();
      result.full = solver.rank() == columns - 1;
    }
  } else {
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(b);
    w = solver.solve(t.transpose()).transpose();
    result.full = solver.rank() == columns;
  }
  result.weights = {targets.rows, basis.columns, std::vector<double>(w.data(), w.data() + w.size())};
  if (t.size() > 0) result.rms = (t - w * b.transpose()).norm() / std::sqrt(static_cast<double>(t.size()));
  return result;
}

}  // namespace face::weights
