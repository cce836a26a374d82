// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/key_shapes_direct.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/nnls.h"
#include "nodes/cluster/assign.h"
#include "nodes/cluster/seed_groups.h"

namespace face::cluster {

KeyShapesDirectResult key_shapes_direct(const Matrix& points, const Matrix* neutral,
                                        const KeyShapesDirectOptions& options) {
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  check_points(points, "points");
  const auto rows = static_cast<Eigen::Index>(points.rows), dims = static_cast<Eigen::Index>(points.columns);
  const auto groups = static_cast<Eigen::Index>(options.groups);
  check(groups <= 63, "groups is ", groups, ", expected at most 63");
  const std::vector<std::size_t> seeds =
      seed_groups(points, static_cast<std::size_t>(groups), static_cast<std::uint64_t>(options.seed));
  RowMatrix x = Eigen::Map<const RowMatrix>(points.values.data(), rows, dims);
  Eigen::RowVectorXd rest = x.colwise().mean();
  if (neutral) {
    check_points(*neutral, "neutral");
    check(neutral->values.size() == points.columns, "neutral has ", neutral->values.size(), " numbers, expected ",
          points.columns, " as points has columns");
    rest = Eigen::Map<const Eigen::RowVectorXd>(neutral->values.data(), dims);
  }
  x.rowwise() -= rest;
  RowMatrix shapes(groups, dims), weights(rows, groups);
  for (Eigen::Index k = 0; k < groups; ++k)
    shapes.row(k) = x.row(static_cast<Eigen::Index>(seeds[static_cast<std::size_t>(k)]));
  for (std::int64_t round = 0;; ++round) {
    Matrix basis{points.columns, static_cast<std::size_t>(groups), {}};
    for (Eigen::Index d = 0; d < dims; ++d)
      for (Eigen::Index k = 0; k < groups; ++k) basis.values.push_back(shapes(k, d));
    NonNegativeLeastSquares solver(basis);
    for (Eigen::Index i = 0; i < rows; ++i) solver.solve(&x(i, 0), &weights(i, 0));
    if (round == options.rounds) break;
    shapes = weights.completeOrthogonalDecomposition().solve(x).eval();
  }
  KeyShapesDirectResult result;
  result.error = (x - weights * shapes).norm() / std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, x.size())));
  result.shapes = {static_cast<std::size_t>(groups), points.columns, {}};
  result.exemplars = {static_cast<std::size_t>(groups), 1, {}};
  for (Eigen::Index k = 0; k < groups; ++k) {
    Eigen::Index nearest = 0;
    (x.rowwise() - shapes.row(k)).rowwise().squaredNorm().minCoeff(&nearest);
    result.exemplars.values.push_back(static_cast<double>(nearest));
    for (Eigen::Index d = 0; d < dims; ++d) result.shapes.values.push_back(shapes(k, d) + rest[d]);
  }
  result.labels = {points.rows, 1, {}};
  for (Eigen::Index i = 0; i < rows; ++i) {
    Eigen::Index most = 0;
    // Weights of shapes of different size are compared by what they move.
    weights.row(i).cwiseProduct(shapes.rowwise().norm().transpose()).maxCoeff(&most);
    result.labels.values.push_back(static_cast<double>(most));
  }
  return result;
}

}  // namespace face::cluster
