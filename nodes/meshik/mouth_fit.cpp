// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/mouth_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/base/check.h"
#include "nodes/types/arkit.h"

namespace face::meshik {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Where a lower lip has rolled in below the teeth, its inner edge is behind them, and what is seen between the lips
// says little about it.
constexpr double rolled_error_mm = 2, least_roll = 0.25;

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

// What the weights of the shapes with rows are expected to be while a viseme is spoken.
struct Expectation {
  MatrixXd inverse;  // of their covariance about 0, in the order of `used`
  bool rolls_lip = false;
};

// Of each viseme; without visemes one, in which every weight is expected alike.
std::vector<Expectation> expectations(const Rig& rig, const std::vector<std::vector<double>>& rows,
                                      const std::vector<std::size_t>& used, const Visemes* visemes,
                                      const MouthPrior& options) {
  const auto count = static_cast<Eigen::Index>(used.size());
  if (visemes == nullptr) {
    double mean = 0;
    for (const std::size_t s : used) mean += dot(rows[s], rows[s]) / static_cast<double>(used.size());
    return {{MatrixXd::Identity(count, count) * (options.restraint * mean)}};
  }
  constexpr double unknown = 0.2;  // deviation of a shape that the table cannot know
  std::vector<std::size_t> arkit;
  for (const std::size_t s : used)
    arkit.push_back(static_cast<std::size_t>(std::find(arkit_names.begin(), arkit_names.end(), rig.shapes[s].name) -
                                             arkit_names.begin()));
  struct Pose {
    VectorXd weights;
    bool rolls_lip = false;
  };
  std::vector<Pose> poses;
  // Lips that must meet do so whatever the jaw does: ARKit's mouthClose shuts what jawOpen at the same weight opens. A
  // lower lip that must touch the teeth rolls in.
  const auto add = [&](const Viseme& viseme, const std::vector<float>& weights) {
    check(weights.size() == arkit_names.size(), "viseme ", viseme.label, " has ", weights.size(), " weights, expected ",
          arkit_names.size());
    VectorXd pose = VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::size_t k = arkit[static_cast<std::size_t>(i)];
      if (k < weights.size()) pose[i] = static_cast<double>(weights[k]);
      if (viseme.contact == "lips" && k == arkit_index("mouthClose"))
        pose[i] = static_cast<double>(weights[arkit_index("jawOpen")]);
      if (viseme.contact == "teeth" && k == arkit_index("mouthRollLower")) pose[i] = 1;
    }
    poses.push_back({pose, viseme.contact == "teeth"});
  };
  for (const Viseme& viseme : visemes->visemes) {
    add(viseme, viseme.weights);
    if (!viseme.glide_weights.empty()) add(viseme, viseme.glide_weights);
  }
  // What all have in common, as if one Gaussian described speech, lets a mouth be on its way between two of them.
  const double scale = options.variety * options.variety;
  MatrixXd common = MatrixXd::Zero(count, count);
  for (const Pose& pose : poses)
    common += scale / static_cast<double>(poses.size()) * pose.weights * pose.weights.transpose();
  if (poses.empty() || options.common_share >= 1) poses.assign(1, {VectorXd::Zero(count)});
  std::vector<Expectation> found;
  for (const Pose& pose : poses) {
    MatrixXd covariance =
        options.common_share * common + (1 - options.common_share) * scale * pose.weights * pose.weights.transpose();
    for (Eigen::Index i = 0; i < count; ++i) {
      const bool known = arkit[static_cast<std::size_t>(i)] < arkit_names.size();
      covariance(i, i) += std::pow(known ? options.own_deviation : unknown, 2);
    }
    found.push_back({options.landmark_error_mm * options.landmark_error_mm * covariance.inverse(), pose.rolls_lip});
  }
  return found;
}

// The least of x'Hx / 2 - slope'x with every x from its `low` to 1, coordinate by coordinate.
VectorXd least_in_box(const MatrixXd& hessian, VectorXd slope, const std::vector<double>& low) {
  const Eigen::Index count = slope.size();
  VectorXd weights = VectorXd::Zero(count);
  constexpr int most_sweeps = 20000;
  double largest = 1;
  for (int sweep = 0; sweep < most_sweeps && largest > 1e-9; ++sweep) {
    largest = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      const double next = std::clamp(weights[i] + slope[i] / hessian(i, i), low[static_cast<std::size_t>(i)], 1.0);
      const double step = next - weights[i];
      if (step == 0) continue;
      weights[i] = next;
      slope -= step * hessian.col(i);
      largest = std::max(largest, std::abs(step));
    }
  }
  return weights;
}

// What is seen of the landmarks, each by how much it counts.
struct Evidence {
  MatrixXd hessian;
  VectorXd slope;
  double log_likely = 0;  // of weights 0
};

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

// gap_weight: of the square of how far a pair is apart, lower_weight: of the y of its lower one, where a coordinate's
// counts as 1.
Evidence weigh(const MatrixXd& basis, const VectorXd& wanted, const Pairs& gaps, const std::vector<bool>& seen,
               double gap_weight, double lower_weight, double error_mm) {
  const Eigen::Index count = basis.cols();
  MatrixXd counted(basis.rows(), count + 1);
  counted << basis, wanted;
  Evidence evidence;
  for (std::size_t k = 0; k < seen.size(); ++k)
    if (!seen[k]) counted.middleRows(static_cast<Eigen::Index>(2 * k), 2).setZero();
  for (const auto& [above, below] : gaps) {
    if (!seen.empty() && !(seen[above] && seen[below])) continue;
    const auto upper = static_cast<Eigen::Index>(2 * above + 1), lower = static_cast<Eigen::Index>(2 * below + 1);
    const Eigen::RowVectorXd parted = gap_weight * (counted.row(upper) - counted.row(lower));
    counted.row(upper) += parted;
    counted.row(lower) = lower_weight * counted.row(lower) - parted;
    evidence.log_likely += std::log(lower_weight + gap_weight * (1 + lower_weight)) / 2;
  }
  evidence.hessian = basis.transpose() * counted.leftCols(count);
  evidence.slope = basis.transpose() * counted.col(count);
  evidence.log_likely -= wanted.dot(counted.col(count)) / (2 * error_mm * error_mm);
  return evidence;
}

double log_determinant(const Eigen::LLT<MatrixXd>& factor) {
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
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
  for (std::size_t upper = 61; upper <= 63; ++upper) {
    const auto find = [&](std::size_t number) {
      const auto at = std::find_if(places.begin(), places.end(), [&](const LandmarkVertex& place) {
        return place.vertex == rig.landmarks68[number];
      });
      return static_cast<std::size_t>(at - places.begin());
    };
    const std::size_t above = find(upper), below = find(128 - upper);
    if (above < places.size() && below < places.size()) gaps_.emplace_back(above, below);
  }
  gap_weight_ = std::pow(prior.landmark_error_mm / prior.gap_error_mm, 2);
  error_mm_ = visemes ? prior.landmark_error_mm : 1;
  while (roll_ < used_.size() && rig.shapes[used_[roll_]].name != "mouthRollLower") ++roll_;
  for (const Expectation& expected : expectations(rig, rows_, used_, visemes, prior))
    expected_.push_back({{expected.inverse.data(), expected.inverse.data() + expected.inverse.size()},
                         expected.rolls_lip && roll_ < used_.size()});
  rolled_weight_ = std::pow(prior.landmark_error_mm / rolled_error_mm, 2);
}

std::vector<double> MouthFit::weights(std::vector<double>& wanted, const std::vector<double>& least,
                                      const std::vector<bool>& seen) const {
  const auto count = static_cast<Eigen::Index>(used_.size()), numbers = static_cast<Eigen::Index>(wanted.size());
  MatrixXd basis(numbers, count);
  for (Eigen::Index i = 0; i < count; ++i)
    basis.col(i) = Eigen::Map<const VectorXd>(rows_[used_[static_cast<std::size_t>(i)]].data(), numbers);
  Eigen::Map<VectorXd> left(wanted.data(), numbers);
  const Evidence plain = weigh(basis, left, gaps_, seen, gap_weight_, 1, error_mm_);
  const Evidence rolled = weigh(basis, left, gaps_, seen, 0, rolled_weight_, error_mm_);
  std::vector<double> low(used_.size(), 0.0);
  for (std::size_t i = 0; i < low.size() && !least.empty(); ++i) low[i] = least[used_[i]];
  // How well each viseme explains what is seen.
  struct Explanation {
    MatrixXd hessian;
    VectorXd slope, solved;
    double log_likely = 0;
  };
  const auto explain = [&](const MatrixXd& inverse, const Evidence& evidence) {
    Explanation found{inverse + evidence.hessian, evidence.slope, {}, evidence.log_likely};
    const Eigen::LLT<MatrixXd> factor(found.hessian);
    found.solved = factor.solve(evidence.slope);
    found.log_likely += (evidence.slope.dot(found.solved) / (error_mm_ * error_mm_) - log_determinant(factor) +
                         log_determinant(Eigen::LLT<MatrixXd>(inverse))) /
                        2;
    return found;
  };
  std::vector<Explanation> explanations;
  double most = -std::numeric_limits<double>::infinity();
  for (const Expected& expected : expected_) {
    const Eigen::Map<const MatrixXd> inverse(expected.inverse.data(), count, count);
    Explanation found = explain(inverse, expected.rolls_lip ? rolled : plain);
    if (expected.rolls_lip && found.solved[static_cast<Eigen::Index>(roll_)] < least_roll)
      found = explain(inverse, plain);
    most = std::max(most, found.log_likely);
    explanations.push_back(std::move(found));
  }
  constexpr double least_share = 1e-3;  // of the likeliest
  VectorXd weights = VectorXd::Zero(count);
  double sum = 0;
  for (const Explanation& found : explanations) {
    const double share = std::exp(found.log_likely - most);
    if (share < least_share) continue;
    weights += share * least_in_box(found.hessian, found.slope, low);
    sum += share;
  }
  weights /= sum;
  left -= basis * weights;
  std::vector<double> all(rows_.size(), 0.0);
  for (Eigen::Index i = 0; i < count; ++i) all[used_[static_cast<std::size_t>(i)]] = weights[i];
  return all;
}

}  // namespace face::meshik
