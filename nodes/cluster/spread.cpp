// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/spread.h"

#include <Eigen/Dense>
#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/cluster/assign.h"

namespace face::cluster {

SpreadResult spread(const Matrix& points, const SpreadOptions& options) {
  check_points(points, "points");
  check(points.rows >= 1 && points.columns >= 1, "points is ", points.rows, " x ", points.columns,
        ", expected at least one point");
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const RowMatrix> x(points.values.data(), static_cast<Eigen::Index>(points.rows),
                                      static_cast<Eigen::Index>(points.columns));
  const RowMatrix centred = x.rowwise() - x.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(centred.transpose() * centred);
  std::vector<std::size_t> exemplars;
  // Eigenvalues ascend.
  for (Eigen::Index a = 0; a < std::min<Eigen::Index>(options.axes, x.cols()); ++a) {
    const Eigen::VectorXd along = centred * parts.eigenvectors().col(x.cols() - 1 - a);
    Eigen::Index low = 0, high = 0;
    along.minCoeff(&low);
    along.maxCoeff(&high);
    exemplars.push_back(static_cast<std::size_t>(low));
    exemplars.push_back(static_cast<std::size_t>(high));
  }
  std::sort(exemplars.begin(), exemplars.end());
  exemplars.erase(std::unique(exemplars.begin(), exemplars.end()), exemplars.end());
  const Assignment found = assign(points, std::move(exemplars));
  return {{points.rows, 1, std::vector<double>(found.labels.begin(), found.labels.end())},
          {found.exemplars.size(), 1, std::vector<double>(found.exemplars.begin(), found.exemplars.end())}};
}

}  // namespace face::cluster
