// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/pixel_normal.h"

#include <Eigen/Dense>
#include <algorithm>

namespace face::model {

PixelNormal pixel_normal(const PixelRows& rows, double kernel) {
  using RowMatrixF = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  PixelNormal normal;
  const std::vector<float> weights = robust_weights(rows.residual, kernel, normal.median);
  normal.noise = std::max(least_noise, normal.median);
  const auto n = static_cast<Eigen::Index>(rows.residual.size()), width = static_cast<Eigen::Index>(rows.columns);
  RowMatrixF j = Eigen::Map<const RowMatrixF>(rows.jacobian.data(), n, width);
  Eigen::VectorXf r = Eigen::Map<const Eigen::VectorXf>(rows.residual.data(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const float w = weights[static_cast<std::size_t>(i / 3)];
    j.row(i) *= w;
    r[i] *= w;
  }
  normal.points = static_cast<double>(n / 3);
  normal.a.resize(rows.columns * rows.columns);
  normal.b.resize(rows.columns);
  Eigen::MatrixXf squares = Eigen::MatrixXf::Zero(width, width);
  squares.selfadjointView<Eigen::Lower>().rankUpdate(j.transpose());
  squares.triangularView<Eigen::StrictlyUpper>() = squares.transpose();
  Eigen::Map<Eigen::MatrixXd>(normal.a.data(), width, width) = squares.cast<double>();
  Eigen::Map<Eigen::VectorXd>(normal.b.data(), width) = -(j.transpose() * r).cast<double>();
  return normal;
}

}  // namespace face::model
