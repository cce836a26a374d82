// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/measure_leakage.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/types/arkit.h"

namespace face::model {

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
  double leakage = nan;
  if (count > used + 1) {
    Eigen::MatrixXd a(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(used));
    Eigen::VectorXd b(static_cast<Eigen::Index>(count));
    for (std::size_t t = 0; t < count; ++t) {
      b[static_cast<Eigen::Index>(t)] = wanted[t];
      for (std::size_t k = 0; k < used; ++k)
        a(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k)) = static_cast<double>(rows[t][k]);
    }
    b.array() -= b.mean();
    a.rowwise() -= a.colwise().mean().eval();
    const double total = b.squaredNorm();
    if (total > 0) {
      const Eigen::VectorXd x = a.colPivHouseholderQr().solve(b);
      leakage = 100 * (1 - (b - a * x).squaredNorm() / total);
    }
  }
  const double chance = count > 1 ? 100.0 * static_cast<double>(used) / static_cast<double>(count - 1) : nan;
  return {{"leakage_percent", "by_chance_percent", "frames"},
          {{options.shape, {leakage, chance, static_cast<double>(count)}}}};
}

}  // namespace face::model
