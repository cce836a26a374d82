// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/measure_leakage.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/types/arkit.h"

namespace face::model {
namespace {

constexpr std::size_t surrogates = 256;
constexpr Eigen::Index parts = 10;

// Percent of the movement that is predicted in a tenth of the frames by what the other nine tenths teach.
double predicted_elsewhere(const Eigen::MatrixXd& basis, const Eigen::VectorXd& movement) {
  Eigen::MatrixXd a(basis.rows(), basis.cols() + 1);
  a << basis, Eigen::VectorXd::Ones(basis.rows());
  const Eigen::MatrixXd gram = a.transpose() * a;
  const Eigen::VectorXd image = a.transpose() * movement;
  double missed = 0, total = 0;
  for (Eigen::Index p = 0; p < parts; ++p) {
    const Eigen::Index first = p * a.rows() / parts, count = (p + 1) * a.rows() / parts - first;
    const auto held = a.middleRows(first, count);
    const auto truth = movement.segment(first, count);
    const Eigen::VectorXd solution = (gram - held.transpose() * held).ldlt().solve(image - held.transpose() * truth);
    missed += (truth - held * solution).squaredNorm();
    total +=
        (truth.array() - (movement.sum() - truth.sum()) / static_cast<double>(a.rows() - count)).matrix().squaredNorm();
  }
  return 100 * (1 - missed / total);
}

}  // namespace

Table measure_leakage(const engine::Seq<Weights>& coefficients, const engine::Seq<Weights>& truth,
                      const MeasureLeakageOptions& options) {
  check(coefficients.size() == truth.size(), "coefficients has ", coefficients.size(), " frames, truth ", truth.size());
  const auto at = std::find(arkit_names.begin(), arkit_names.end(), options.shape);
  check(at != arkit_names.end(), "shape is \"", options.shape, "\", expected a name of ARKit's, as eyeBlinkLeft");
  const auto index = static_cast<std::size_t>(at - arkit_names.begin());
  std::vector<std::vector<float>> rows;
  std::vector<double> wanted;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    const auto row = coefficients.at(t);
    if (row->values.empty()) continue;
    const auto weights = truth.at(t);
    check(index < weights->values.size(), "frame ", truth.id(t), " has ", weights->values.size(), " weights, expected ",
          options.shape, " at ", index);
    check(rows.empty() || row->values.size() == rows[0].size(), "frame ", coefficients.id(t), " has ",
          row->values.size(), " coefficients, others ", rows.empty() ? 0 : rows[0].size());
    rows.push_back(row->values);
    wanted.push_back(static_cast<double>(weights->values[index]));
  }
  const std::size_t count = rows.size(),
                    used = count > 0 ? std::min(rows[0].size(), static_cast<std::size_t>(options.components)) : 0;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  double leakage = nan, by_chance = nan, likely = nan, elsewhere = nan;
  if (count > used + 1) {
    Eigen::MatrixXd a(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(used));
    for (std::size_t t = 0; t < count; ++t)
      for (std::size_t k = 0; k < used; ++k)
        a(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k)) = static_cast<double>(rows[t][k]);
    a.rowwise() -= a.colwise().mean().eval();
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
    const Eigen::MatrixXd basis =
        qr.householderQ() * Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(count), qr.rank());
    const double mean = std::accumulate(wanted.begin(), wanted.end(), 0.0) / static_cast<double>(count);
    for (double& w : wanted) w -= mean;
    const double total =
        Eigen::Map<const Eigen::VectorXd>(wanted.data(), static_cast<Eigen::Index>(count)).squaredNorm();
    // Percent of the movement, moved round by some frames, that lies in the coefficients' span.
    const auto explained = [&](std::size_t moved) {
      Eigen::VectorXd b(static_cast<Eigen::Index>(count));
      std::rotate_copy(wanted.begin(), wanted.begin() + static_cast<std::ptrdiff_t>(moved), wanted.end(), b.data());
      return 100 * (basis.transpose() * b).squaredNorm() / total;
    };
    if (total > 0) {
      leakage = explained(0);
      std::vector<double> moved;
      const std::size_t steps = std::min(surrogates, count - 1);
      for (std::size_t i = 1; i <= steps; ++i) moved.push_back(explained(i * count / (steps + 1)));
      by_chance = std::accumulate(moved.begin(), moved.end(), 0.0) / static_cast<double>(steps);
      std::sort(moved.begin(), moved.end());
      likely = moved[(moved.size() - 1) * 19 / 20];
      if (static_cast<Eigen::Index>(count) > 2 * (basis.cols() + parts))
        elsewhere = predicted_elsewhere(
            basis, Eigen::Map<const Eigen::VectorXd>(wanted.data(), static_cast<Eigen::Index>(count)));
    }
  }
  return {{"leakage_percent", "by_chance_percent", "likely_by_chance_percent", "frames", "elsewhere_percent"},
          {{options.shape, {leakage, by_chance, likely, static_cast<double>(count), elsewhere}}}};
}

}  // namespace face::model
