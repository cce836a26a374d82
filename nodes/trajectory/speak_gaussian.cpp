// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak_gaussian.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/trajectory/gaussian_trajectory.h"
#include "nodes/trajectory/lips_shut.h"

namespace face::trajectory {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of the pull of a frame: D'D of the paper.
double pull(const Phone& phone, const Phones& phones, Normalise normalise) {
  const double length_s = std::max(1e-3, phone.end_s - phone.start_s);
  if (normalise == Normalise::utterance) return std::max(0.0, 1 - length_s / phones.duration_s);
  if (normalise == Normalise::duration) return 0.1 / length_s;
  return 1;
}

std::vector<std::vector<std::string>> alike_on_the_lips() {
  return {{"P", "B", "M"},         {"F", "V"}, {"TH", "DH"}, {"T", "D", "N"}, {"K", "G", "NG"}, {"S", "Z"},
          {"SH", "ZH", "CH", "JH"}};
}

// Block tridiagonal: (W_t + lambda neighbours) x_t - lambda x_(t-1) - lambda x_(t+1) = W_t mu_t, O(frames x dims^3).
std::vector<double> solve_full(const std::vector<const MatrixXd*>& precision, const std::vector<double>& pulls,
                               const std::vector<VectorXd>& mean, double smoothness) {
  const std::size_t frames = precision.size();
  const Eigen::Index dims = mean[0].size();
  std::vector<MatrixXd> ratio(frames);
  std::vector<VectorXd> x(frames);
  for (std::size_t t = 0; t < frames; ++t) {
    MatrixXd diagonal = pulls[t] * *precision[t];
    VectorXd right = diagonal * mean[t];
    diagonal.diagonal().array() += (t > 0 ? smoothness : 0) + (t + 1 < frames ? smoothness : 0);
    if (t > 0) {
      diagonal -= smoothness * ratio[t - 1];
      right += smoothness * x[t - 1];
    }
    const Eigen::LLT<MatrixXd> factor(diagonal);
    check(factor.info() == Eigen::Success, "nothing pulls the frames up to ", t);
    if (t + 1 < frames) ratio[t] = factor.solve(MatrixXd::Identity(dims, dims) * smoothness);
    x[t] = factor.solve(right);
  }
  for (std::size_t t = frames - 1; t-- > 0;) x[t] += ratio[t] * x[t + 1];
  std::vector<double> values;
  for (const VectorXd& frame : x) values.insert(values.end(), frame.data(), frame.data() + dims);
  return values;
}

}  // namespace

const PhoneStatistic& find_statistic(const PhoneStatistics& statistics, const std::string& label) {
  const std::string whole = label.substr(0, label.find('.'));
  std::vector<std::string> names = {label, whole, whole + ".c", whole + ".r"};
  for (const std::vector<std::string>& group : alike_on_the_lips()) {
    if (std::find(group.begin(), group.end(), whole) == group.end()) continue;
    // A release is like other releases alone: M and N are closures.
    for (const char* half : {".c", "", ".r"})
      if (label.ends_with(".r") == (std::string(half) == ".r"))
        for (const std::string& other : group) names.push_back(other + half);
  }
  for (const std::string& name : names)
    for (const PhoneStatistic& phone : statistics.phones)
      if (phone.label == name) return phone;
  return statistics.all;
}

Timeline speak_gaussian(const Phones& phones, const PhoneStatistics& statistics, engine::SeqWriter<Weights>& weights,
                        const SpeakGaussianOptions& options) {
  check(!phones.phones.empty(), "there are no phones to speak");
  check(options.closing_s >= 0 && options.closing_s <= 1, "closing_s is ", options.closing_s, ", expected 0 to 1");
  const std::size_t dims = statistics.all.mean.size(), frames = frame_count(phones, options.rate_hz);
  check(dims > 0, "the statistics are of no animation parameters");
  for (const PhoneStatistic& phone : statistics.phones)
    check(phone.mean.size() == dims && phone.covariance.size() == dims * dims, "the statistic of \"", phone.label,
          "\" has ", phone.mean.size(), " means and ", phone.covariance.size(), " covariances, expected ", dims,
          " and ", dims * dims);
  // Per phone of the speech; all of one label are alike.
  std::vector<MatrixXd> precisions;
  std::vector<const PhoneStatistic*> used;
  for (const Phone& phone : phones.phones) {
    used.push_back(&find_statistic(statistics, phone.label));
    const auto n = static_cast<Eigen::Index>(dims);
    MatrixXd covariance = Eigen::Map<const MatrixXd>(used.back()->covariance.data(), n, n);
    if (options.covariance == CovarianceUse::diagonal) covariance = covariance.diagonal().asDiagonal().toDenseMatrix();
    precisions.push_back(covariance.inverse());
  }
  std::vector<std::size_t> phone_of(frames);
  std::vector<bool> held(frames, false);
  for (std::size_t t = 0, p = 0; t < frames; ++t) {
    const double time_s = static_cast<double>(t) / options.rate_hz;
    while (p + 1 < phones.phones.size() && phones.phones[p].end_s <= time_s) ++p;
    phone_of[t] = p;
  }
  for (std::size_t p = 0; options.closures != Closures::free && p < phones.phones.size(); ++p) {
    if (!is_bilabial_closure(phones.phones[p].label)) continue;
    const double middle_s = (phones.phones[p].start_s + phones.phones[p].end_s) / 2;
    const auto frame = static_cast<std::size_t>(std::max(0.0, std::round(middle_s * options.rate_hz)));
    phone_of[std::min(frame, frames - 1)] = p;
    held[std::min(frame, frames - 1)] = true;
  }
  std::vector<double> shut(frames, 0.0);
  for (std::size_t t = 0; options.closing_s > 0 && options.closures == Closures::rest && t < frames; ++t)
    shut[t] = lips_shut(phones, static_cast<double>(t) / options.rate_hz, options.closing_s);
  const auto target = [&](std::size_t t, std::size_t k) {
    return held[t] && options.closures == Closures::rest ? 0.0 : (1 - shut[t]) * used[phone_of[t]]->mean[k];
  };
  // So much stronger than all else that what is left of the error is far below a weight's last bit.
  constexpr double hold = 1e9;
  const double smoothness = smoothness_at(options.smoothness, 30, options.rate_hz);
  std::vector<double> values, pulls(frames);
  for (std::size_t t = 0; t < frames; ++t)
    pulls[t] = (held[t] ? hold * (1 + smoothness) : 1) * pull(phones.phones[phone_of[t]], phones, options.normalise);
  if (options.covariance == CovarianceUse::full) {
    std::vector<const MatrixXd*> precision;
    std::vector<VectorXd> mean;
    for (std::size_t t = 0; t < frames; ++t) {
      precision.push_back(&precisions[phone_of[t]]);
      mean.emplace_back(static_cast<Eigen::Index>(dims));
      for (std::size_t k = 0; k < dims; ++k) mean.back()[static_cast<Eigen::Index>(k)] = target(t, k);
    }
    values = solve_full(precision, pulls, mean, smoothness);
  } else {
    TrajectoryTargets targets{frames, dims, {}, {}};
    for (std::size_t t = 0; t < frames; ++t)
      for (std::size_t k = 0; k < dims; ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        targets.precision.push_back(pulls[t] * precisions[phone_of[t]](i, i));
        targets.target.push_back(target(t, k));
      }
    values = solve_trajectory(targets, smoothness);
  }
  Timeline timeline;
  for (std::size_t t = 0; t < frames; ++t) {
    Weights frame;
    for (std::size_t k = 0; k < dims; ++k) frame.values.push_back(static_cast<float>(values[t * dims + k]));
    weights.push(std::move(frame));
    timeline.time_s.push_back(static_cast<double>(t) / options.rate_hz);
  }
  timeline.duration_s = static_cast<double>(frames) / options.rate_hz;
  return timeline;
}

}  // namespace face::trajectory
