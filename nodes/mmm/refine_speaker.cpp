// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/refine_speaker.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/trajectory/gaussian_trajectory.h"

namespace face::mmm {
namespace {

using Eigen::Index;

bool is_bilabial_closure(const std::string& label) {
  return label == "P.c" || label == "B.c" || label == "M" || label == "P" || label == "B";
}

// So much stronger than all else that what is left of the error is far below a weight's last bit.
constexpr double hold = 1e9;

struct Frames {
  std::vector<std::size_t> label;  // per frame, place in the statistics
  std::vector<double> pull;
};

// Which phone pulls which frame, as in trajectory::speak_gaussian.
Frames frames_of(const Timeline& timeline, const Phones& phones, const std::vector<std::size_t>& label_of_phone,
                 const RefineSpeakerOptions& options, double smoothness) {
  Frames frames;
  std::size_t p = 0;
  for (const double time_s : timeline.time_s) {
    while (p + 1 < phones.phones.size() && phones.phones[p].end_s <= time_s) ++p;
    frames.label.push_back(label_of_phone[p]);
  }
  frames.pull.assign(frames.label.size(), 1.0);
  for (std::size_t i = 0; options.hold_closures && i < phones.phones.size(); ++i) {
    if (!is_bilabial_closure(phones.phones[i].label)) continue;
    const double middle_s = (phones.phones[i].start_s + phones.phones[i].end_s) / 2;
    const auto next = std::lower_bound(timeline.time_s.begin(), timeline.time_s.end(), middle_s);
    auto at = std::min(static_cast<std::size_t>(next - timeline.time_s.begin()), timeline.time_s.size() - 1);
    if (at > 0 && middle_s - timeline.time_s[at - 1] < timeline.time_s[at] - middle_s) --at;
    frames.label[at] = label_of_phone[i];
    frames.pull[at] = hold * (1 + smoothness);
  }
  return frames;
}

}  // namespace

PhoneStatistics refine_speaker(const engine::Seq<Weights>& weights, const Timeline& timeline, const Phones& phones,
                               const PhoneStatistics& statistics, const RefineSpeakerOptions& options) {
  const std::size_t count = timeline.time_s.size(), dims = statistics.all.mean.size(),
                    labels = statistics.phones.size();
  check(weights.size() == count, "there are ", weights.size(), " frames of weights and ", count,
        " times, expected as many");
  check(!phones.phones.empty(), "there are no phones");
  check(count > 0 && timeline.duration_s > 0, "the timeline has ", count, " frames in ", timeline.duration_s, " s");
  for (const PhoneStatistic& phone : statistics.phones)
    check(phone.mean.size() == dims && phone.covariance.size() == dims * dims, "the statistic of \"", phone.label,
          "\" has ", phone.mean.size(), " means and ", phone.covariance.size(), " covariances, expected ", dims,
          " and ", dims * dims);
  check(statistics.all.covariance.size() == dims * dims, "the statistic of all speech has ",
        statistics.all.covariance.size(), " covariances, expected ", dims * dims);
  // The last one stands for labels that have no statistic of their own.
  std::vector<std::size_t> label_of_phone;
  for (const Phone& phone : phones.phones) {
    const auto found = std::find_if(statistics.phones.begin(), statistics.phones.end(),
                                    [&](const PhoneStatistic& s) { return s.label == phone.label; });
    label_of_phone.push_back(static_cast<std::size_t>(found - statistics.phones.begin()));
  }
  const double rate_hz = static_cast<double>(count) / timeline.duration_s;
  const double smoothness = trajectory::smoothness_at(options.smoothness, 30, rate_hz);
  const Frames frames = frames_of(timeline, phones, label_of_phone, options, smoothness);

  std::vector<std::vector<float>> values;
  for (std::size_t t = 0; t < count; ++t) {
    values.push_back(weights.at(t)->values);
    check(values.back().empty() || values.back().size() == dims, "frame ", weights.id(t), " has ", values.back().size(),
          " weights, the statistics are of ", dims);
    for (const float value : values.back())
      check(std::isfinite(value), "frame ", weights.id(t), " has a weight of ", value, ", expected finite numbers");
  }
  PhoneStatistics refined = statistics;
  const auto statistic = [&](std::size_t label) -> const PhoneStatistic& {
    return label < labels ? statistics.phones[label] : statistics.all;
  };
  for (std::size_t d = 0; d < dims; ++d) {
    // All columns of A at once, side by side as dimensions of one trajectory.
    trajectory::TrajectoryTargets targets{count, labels + 1, {}, {}};
    targets.precision.reserve(count * (labels + 1));
    targets.target.reserve(count * (labels + 1));
    for (std::size_t t = 0; t < count; ++t)
      for (std::size_t k = 0; k <= labels; ++k) {
        const double variance = statistic(frames.label[t]).covariance[d * dims + d];
        check(variance > 0, "the statistic of \"", statistic(frames.label[t]).label, "\" has a variance of ", variance,
              ", expected more than 0");
        targets.precision.push_back(frames.pull[t] / variance);
        targets.target.push_back(frames.label[t] == k ? 1 : 0);
      }
    const std::vector<double> response = trajectory::solve_trajectory(targets, smoothness);
    const auto width = static_cast<Index>(labels + 1);
    Eigen::VectorXd plain(width);
    for (std::size_t k = 0; k <= labels; ++k) plain[static_cast<Index>(k)] = statistic(k).mean[d];
    Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(width, width) * std::max(options.restraint, 1e-9);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(width);
    for (std::size_t t = 0; t < count; ++t) {
      if (values[t].empty()) continue;
      const Eigen::Map<const Eigen::VectorXd> row(&response[t * (labels + 1)], width);
      normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
      right += row * (static_cast<double>(values[t][d]) - row.dot(plain));
    }
    const Eigen::MatrixXd full = normal.selfadjointView<Eigen::Lower>();
    const Eigen::VectorXd change = full.ldlt().solve(right);
    for (std::size_t k = 0; k < labels; ++k) refined.phones[k].mean[d] += change[static_cast<Index>(k)];
  }
  return refined;
}

}  // namespace face::mmm
