// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/mouth_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/types/arkit.h"

namespace face::meshik {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Offsets of the landmarks' x and y by each shape that may be used; empty for the others.
std::vector<std::vector<double>> shape_rows(const Rig& rig, const std::vector<LandmarkVertex>& places) {
  std::vector<std::vector<double>> rows(rig.shapes.size());
  for (std::size_t s = 0; s < rig.shapes.size(); ++s) {
    const Shape& shape = rig.shapes[s];
    if (!shape.name.starts_with("jaw") && !shape.name.starts_with("mouth")) continue;
    std::vector<double> row(2 * places.size(), 0.0);
    bool moves = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto at = std::lower_bound(shape.vertices.begin(), shape.vertices.end(), places[i].vertex);
      if (at == shape.vertices.end() || *at != places[i].vertex) continue;
      for (std::size_t d = 0; d < 2; ++d) {
        row[2 * i + d] =
            static_cast<double>(shape.offsets_mm[static_cast<std::size_t>(at - shape.vertices.begin())][d]);
        moves = moves || row[2 * i + d] != 0;
      }
    }
    if (moves) rows[s] = std::move(row);
  }
  return rows;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// What the weights of the shapes with rows are expected to be: the inverse of their covariance about 0, in the order of
// `used`. Without visemes every weight is expected alike.
MatrixXd expectation(const Rig& rig, const std::vector<std::vector<double>>& rows, const std::vector<std::size_t>& used,
                     const Visemes* visemes, const MouthPrior& options) {
  const auto count = static_cast<Eigen::Index>(used.size());
  if (visemes == nullptr) {
    double mean = 0;
    for (const std::size_t s : used) mean += dot(rows[s], rows[s]) / static_cast<double>(used.size());
    return MatrixXd::Identity(count, count) * (options.restraint * mean);
  }
  constexpr double unknown = 0.2;  // deviation of a shape that the table cannot know
  std::vector<std::size_t> arkit;
  for (const std::size_t s : used)
    arkit.push_back(static_cast<std::size_t>(std::find(arkit_names.begin(), arkit_names.end(), rig.shapes[s].name) -
                                             arkit_names.begin()));
  std::vector<VectorXd> poses;
  // Lips that must meet do so whatever the jaw does: ARKit's mouthClose shuts what jawOpen at the same weight opens.
  const auto close = std::find(arkit.begin(), arkit.end(), arkit_index("mouthClose"));
  const auto add = [&](const Viseme& viseme, const std::vector<float>& weights) {
    check(weights.size() == arkit_names.size(), "viseme ", viseme.label, " has ", weights.size(), " weights, expected ",
          arkit_names.size());
    VectorXd pose = VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::size_t k = arkit[static_cast<std::size_t>(i)];
      if (k < weights.size()) pose[i] = static_cast<double>(weights[k]);
    }
    if (viseme.contact == "lips" && close != arkit.end())
      pose[close - arkit.begin()] = static_cast<double>(weights[arkit_index("jawOpen")]);
    poses.push_back(pose);
  };
  for (const Viseme& viseme : visemes->visemes) {
    add(viseme, viseme.weights);
    if (!viseme.glide_weights.empty()) add(viseme, viseme.glide_weights);
  }
  MatrixXd covariance = MatrixXd::Zero(count, count);
  for (const VectorXd& pose : poses)
    covariance += options.variety * options.variety / static_cast<double>(poses.size()) * pose * pose.transpose();
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool known = arkit[static_cast<std::size_t>(i)] < arkit_names.size();
    covariance(i, i) += std::pow(known ? options.own_deviation : unknown, 2);
  }
  return options.landmark_error_mm * options.landmark_error_mm * covariance.inverse();
}

}  // namespace

MouthFit::MouthFit(const Rig& rig, const std::vector<LandmarkVertex>& places, const Visemes* visemes,
                   const MouthPrior& prior) {
  for (const LandmarkVertex& place : places)
    check(place.vertex < rig.neutral.points_mm.size(), "a landmark is vertex ", place.vertex, ", expected one below ",
          rig.neutral.points_mm.size());
  rows_ = shape_rows(rig, places);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (!rows_[i].empty()) used_.push_back(i);
  check(!used_.empty(), "no jaw or mouth shape of the rig moves a landmark");
  const MatrixXd expected = expectation(rig, rows_, used_, visemes, prior);
  expected_.assign(expected.data(), expected.data() + expected.size());
}

std::vector<double> MouthFit::weights(std::vector<double>& wanted, const std::vector<double>& least,
                                      const std::vector<bool>& seen) const {
  const auto count = static_cast<Eigen::Index>(used_.size()), numbers = static_cast<Eigen::Index>(wanted.size());
  MatrixXd basis(numbers, count);
  for (Eigen::Index i = 0; i < count; ++i)
    basis.col(i) = Eigen::Map<const VectorXd>(rows_[used_[static_cast<std::size_t>(i)]].data(), numbers);
  MatrixXd counted = basis;
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (!seen[k]) counted.middleRows(static_cast<Eigen::Index>(2 * k), 2).setZero();
  Eigen::Map<VectorXd> left(wanted.data(), numbers);
  const MatrixXd hessian = Eigen::Map<const MatrixXd>(expected_.data(), count, count) + counted.transpose() * basis;
  VectorXd slope = counted.transpose() * left, weights = VectorXd::Zero(count);
  constexpr int most_sweeps = 20000;
  double largest = 1;
  for (int sweep = 0; sweep < most_sweeps && largest > 1e-9; ++sweep) {
    largest = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      const double low = least.empty() ? 0 : least[used_[static_cast<std::size_t>(i)]];
      const double next = std::clamp(weights[i] + slope[i] / hessian(i, i), low, 1.0), step = next - weights[i];
      if (step == 0) continue;
      weights[i] = next;
      slope -= step * hessian.col(i);
      largest = std::max(largest, std::abs(step));
    }
  }
  left -= basis * weights;
  std::vector<double> all(rows_.size(), 0.0);
  for (Eigen::Index i = 0; i < count; ++i) all[used_[static_cast<std::size_t>(i)]] = weights[i];
  return all;
}

}  // namespace face::meshik
