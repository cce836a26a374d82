// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/train_phones.h"

#include <Eigen/Dense>
#include <cmath>
#include <map>

#include "nodes/base/check.h"
#include "nodes/trajectory/lips_shut.h"

namespace face::trajectory {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of frames x = share mu + noise.
struct Sums {
  std::int64_t frames = 0;
  double weight = 0;  // sum of share^2
  VectorXd sum;
  MatrixXd squares;

  void add(const VectorXd& x, double share = 1) {
    if (frames++ == 0) {
      sum = VectorXd::Zero(x.size());
      squares = MatrixXd::Zero(x.size(), x.size());
    }
    weight += share * share;
    sum += share * x;
    squares += x * x.transpose();
  }
  VectorXd mean() const { return sum / weight; }
  // About `centre`, which need not be the mean.
  MatrixXd scatter(const VectorXd& centre) const {
    return squares - sum * centre.transpose() - centre * sum.transpose() + weight * centre * centre.transpose();
  }
};

PhoneStatistic statistic(const std::string& label, std::int64_t frames, const VectorXd& mean,
                         const MatrixXd& covariance, double least_sigma) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> parts(covariance);
  const VectorXd floored = parts.eigenvalues().cwiseMax(least_sigma * least_sigma);
  MatrixXd full = parts.eigenvectors() * floored.asDiagonal() * parts.eigenvectors().transpose();
  full = ((full + full.transpose()) / 2).eval();
  return {label, frames, {mean.data(), mean.data() + mean.size()}, {full.data(), full.data() + full.size()}};
}

}  // namespace

PhoneStatistics train_phones(const engine::Seq<Weights>& weights, const Timeline& timeline, const Phones& phones,
                             const TrainPhonesOptions& options) {
  check(weights.size() == timeline.time_s.size(), "there are ", weights.size(), " frames of weights and ",
        timeline.time_s.size(), " times, expected as many");
  check(options.closing_s >= 0 && options.closing_s <= 1, "closing_s is ", options.closing_s, ", expected 0 to 1");
  constexpr double least_share = 0.1;
  std::map<std::string, Sums> by_phone, by_free_phone;
  // Sums are about the first frame, so that what all have in common costs no digits.
  Sums all;
  VectorXd origin;
  std::size_t frame = 0, phone = 0;
  for (const Weights& here : weights) {
    const std::size_t f = frame++;
    if (here.values.empty()) continue;
    const double end_s = frame < timeline.time_s.size() ? timeline.time_s[frame] : timeline.duration_s;
    const double middle_s = (timeline.time_s[f] + end_s) / 2;
    while (phone < phones.phones.size() && phones.phones[phone].end_s <= middle_s) ++phone;
    if (phone == phones.phones.size()) break;
    VectorXd x(static_cast<Eigen::Index>(here.values.size()));
    for (std::size_t k = 0; k < here.values.size(); ++k) {
      check(std::isfinite(here.values[k]), "frame ", weights.id(f), " has a weight of ", here.values[k],
            ", expected finite numbers");
      x[static_cast<Eigen::Index>(k)] = static_cast<double>(here.values[k]);
    }
    if (all.frames == 0) origin = x;
    check(x.size() == origin.size(), "frame ", weights.id(f), " has ", x.size(), " weights, expected ", origin.size(),
          " as the first one");
    all.add(x - origin);
    if (phones.phones[phone].start_s > middle_s) continue;
    const std::string& label = phones.phones[phone].label;
    by_phone[label].add(x - origin);
    if (options.closing_s == 0) continue;
    const double share = is_bilabial_closure(label) ? 1 : 1 - lips_shut(phones, middle_s, options.closing_s);
    if (share >= least_share) by_free_phone[label].add(x - share * origin, share);
  }
  check(all.frames > 0, "no frame with weights lies within the phones");

  PhoneStatistics result;
  const MatrixXd common = all.scatter(all.mean()) / static_cast<double>(all.frames);
  result.all = statistic("", all.frames, all.mean() + origin, common, options.least_sigma);
  const auto prior = static_cast<double>(options.prior_frames);
  for (const auto& [label, sums] : by_free_phone) by_phone[label] = sums;
  for (const auto& [label, sums] : by_phone) {
    const MatrixXd covariance = (sums.scatter(sums.mean()) + prior * common) / (sums.weight + prior);
    result.phones.push_back(statistic(label, sums.frames, sums.mean() + origin, covariance, options.least_sigma));
  }
  return result;
}

}  // namespace face::trajectory
