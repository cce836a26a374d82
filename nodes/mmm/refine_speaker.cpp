// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/refine_speaker.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/mmm/spoken_steps.h"
#include "nodes/trajectory/gaussian_trajectory.h"
#include "nodes/trajectory/speak_gaussian.h"

namespace face::mmm {
namespace {

using Eigen::Index;

std::size_t find_label(const PhoneStatistics& statistics, const std::string& label) {
  const auto found = std::find_if(statistics.phones.begin(), statistics.phones.end(),
                                  [&](const PhoneStatistic& s) { return s.label == label; });
  return static_cast<std::size_t>(found - statistics.phones.begin());
}

// The statistics, and one of the silence in which speech begins and ends: the mean of its frames, as spread as others.
PhoneStatistics with_edges(PhoneStatistics statistics, const std::vector<std::string>& labels, const SpokenSteps& path,
                           const std::vector<std::vector<float>>& values, std::size_t steps) {
  PhoneStatistic edge = trajectory::find_statistic(statistics, "SIL");
  edge.label = "SIL.edge";
  edge.frames = 0;
  std::fill(edge.mean.begin(), edge.mean.end(), 0.0);
  for (std::size_t t = 0; t < values.size(); ++t) {
    if (values[t].empty() || labels[path.phone[t * steps]] != edge.label) continue;
    ++edge.frames;
    for (std::size_t k = 0; k < edge.mean.size(); ++k) edge.mean[k] += static_cast<double>(values[t][k]);
  }
  if (edge.frames == 0) return statistics;
  for (double& mean : edge.mean) mean /= static_cast<double>(edge.frames);
  const std::size_t before = find_label(statistics, edge.label);
  if (before < statistics.phones.size())
    statistics.phones[before] = std::move(edge);
  else
    statistics.phones.push_back(std::move(edge));
  return statistics;
}

}  // namespace

PhoneStatistics refine_speaker(const engine::Seq<Weights>& weights, const Timeline& timeline, const Phones& phones,
                               const PhoneStatistics& statistics, const RefineSpeakerOptions& options) {
  const std::size_t count = timeline.time_s.size(), dims = statistics.all.mean.size();
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
  check(options.steps >= 1, "steps is ", options.steps, ", expected at least 1");
  const std::vector<std::string> spoken = spoken_labels(phones);
  const auto steps = static_cast<std::size_t>(options.steps);
  const SpokenSteps path =
      spoken_steps(phones, step_times(timeline.time_s, timeline.duration_s, steps), options.hold_closures);
  const double rate_hz = static_cast<double>(count) / timeline.duration_s;
  const double smoothness = trajectory::smoothness_at(options.smoothness, 30, rate_hz * static_cast<double>(steps));

  std::vector<std::vector<float>> values;
  for (std::size_t t = 0; t < count; ++t) {
    values.push_back(weights.at(t)->values);
    check(values.back().empty() || values.back().size() == dims, "frame ", weights.id(t), " has ", values.back().size(),
          " weights, the statistics are of ", dims);
    for (const float value : values.back())
      check(std::isfinite(value), "frame ", weights.id(t), " has a weight of ", value, ", expected finite numbers");
  }
  const PhoneStatistics plain_ones = with_edges(statistics, spoken, path, values, steps);
  PhoneStatistics refined = plain_ones;
  const std::size_t labels = plain_ones.phones.size();
  // The last one stands for labels that have no statistic of their own.
  std::vector<std::size_t> label_of_phone;
  for (const std::string& label : spoken) {
    const PhoneStatistic& found = trajectory::find_statistic(plain_ones, label);
    label_of_phone.push_back(find_label(plain_ones, found.label));
  }
  const auto label_at = [&](std::size_t step) { return label_of_phone[path.phone[step]]; };
  const auto statistic = [&](std::size_t label) -> const PhoneStatistic& {
    return label < labels ? plain_ones.phones[label] : plain_ones.all;
  };
  for (std::size_t d = 0; d < dims; ++d) {
    // All columns of A at once, side by side as dimensions of one trajectory.
    trajectory::TrajectoryTargets targets{count * steps, labels + 1, {}, {}};
    targets.precision.reserve(count * steps * (labels + 1));
    targets.target.reserve(count * steps * (labels + 1));
    for (std::size_t t = 0; t < count * steps; ++t) {
      const double variance = statistic(label_at(t)).covariance[d * dims + d];
      check(variance > 0, "the statistic of \"", statistic(label_at(t)).label, "\" has a variance of ", variance,
            ", expected more than 0");
      const double pull = path.held[t] ? held_pull * (1 + smoothness) : 1;
      for (std::size_t k = 0; k <= labels; ++k) {
        targets.precision.push_back(pull / variance);
        targets.target.push_back(label_at(t) == k ? 1 : 0);
      }
    }
    const std::vector<double> response = trajectory::solve_trajectory(targets, smoothness);
    const auto width = static_cast<Index>(labels + 1);
    Eigen::VectorXd plain(width);
    for (std::size_t k = 0; k <= labels; ++k) plain[static_cast<Index>(k)] = statistic(k).mean[d];
    Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(width, width) * std::max(options.restraint, 1e-9);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(width);
    for (std::size_t t = 0; t < count; ++t) {
      if (values[t].empty()) continue;
      const Eigen::Map<const Eigen::VectorXd> row(&response[t * steps * (labels + 1)], width);
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
