// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/compare_spaces.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/model/check_model.h"
#include "nodes/model/skin_modes.h"

namespace face::model {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
constexpr double rank_tolerance = 1e-9;  // of the largest singular value

// Orthonormal columns that span the rows of a matrix.
Eigen::MatrixXd span_of(const Eigen::MatrixXd& rows) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows.transpose());
  qr.setThreshold(rank_tolerance);
  return qr.householderQ() * Eigen::MatrixXd::Identity(rows.cols(), qr.rank());
}

// Vectors over the skin of a space's components from `first`, every `stride`th, one standard deviation long.
Matrix vectors_of(const LinearSpace& space, const std::vector<bool>& skin, std::size_t first, std::size_t stride) {
  Matrix matrix;
  const std::size_t vertices = skin.size();
  for (std::size_t k = first; k < space.size(); k += stride) {
    ++matrix.rows;
    for (std::size_t v = 0; v < vertices; ++v)
      if (skin[v])
        for (std::size_t axis = 0; axis < 3; ++axis)
          matrix.values.push_back(static_cast<double>(space.sigmas[k]) * space.modes[k * vertices + v][axis]);
  }
  matrix.columns = 3 * static_cast<std::size_t>(std::count(skin.begin(), skin.end(), true));
  return matrix;
}

TableRow row_of(const std::string& name, const Matrix& examples, const Matrix& basis) {
  if (examples.rows == 0 || basis.rows == 0) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {name, {none, none, none}};
  }
  const SpaceComparison found = compare(examples, basis);
  return {name, {found.angles_deg.back(), found.angles_deg.front(), found.residual_ratio}};
}

}  // namespace

SpaceComparison compare(const Matrix& examples, const Matrix& basis) {
  check(examples.columns == basis.columns, "examples have ", examples.columns, " columns, the basis has ",
        basis.columns);
  check(examples.rows > 0 && basis.rows > 0, "there are ", examples.rows, " examples and ", basis.rows,
        " basis vectors, expected at least 1 of each");
  const auto map = [](const Matrix& m) {
    return Eigen::Map<const Rows>(m.values.data(), static_cast<Eigen::Index>(m.rows),
                                  static_cast<Eigen::Index>(m.columns));
  };
  const Eigen::MatrixXd e = map(examples);
  const Eigen::MatrixXd qe = span_of(e), qp = span_of(map(basis));
  SpaceComparison result;
  const Eigen::MatrixXd residual = e - (e * qp) * qp.transpose();
  result.residual_ratio = e.squaredNorm() > 0 ? residual.squaredNorm() / e.squaredNorm() : 0;
  const Eigen::MatrixXd& small = qe.cols() <= qp.cols() ? qe : qp;
  const Eigen::MatrixXd& large = qe.cols() <= qp.cols() ? qp : qe;
  if (small.cols() == 0) {
    result.angles_deg = {0};
    return result;
  }
  const Eigen::MatrixXd inside = large.transpose() * small;
  const Eigen::VectorXd cosines = inside.jacobiSvd().singularValues();                  // descending
  const Eigen::VectorXd sines = (small - large * inside).jacobiSvd().singularValues();  // descending
  const Eigen::Index count = small.cols();
  for (Eigen::Index i = 0; i < count; ++i) {
    const double cosine = std::clamp(cosines[i], 0.0, 1.0), sine = std::clamp(sines[count - 1 - i], 0.0, 1.0);
    const double angle = cosine * cosine > 0.5 ? std::asin(sine) : std::acos(cosine);
    result.angles_deg.push_back(angle * 180 / std::numbers::pi);
  }
  return result;
}

Table compare_spaces(const MorphableModel& model) {
  check_model(model);
  const std::vector<bool> skin = skin_vertices(model.mean);
  Table table;
  table.columns = {"angle_deg", "smallest_angle_deg", "residual_ratio"};
  table.rows.push_back(
      row_of("expression", vectors_of(model.expression, skin, 0, 1), vectors_of(model.identity, skin, 0, 1)));
  table.rows.push_back(
      row_of("control", vectors_of(model.identity, skin, 1, 2), vectors_of(model.identity, skin, 0, 2)));
  return table;
}

}  // namespace face::model
