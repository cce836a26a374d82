// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/speak_path.h"

#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/mmm/spoken_steps.h"
#include "nodes/trajectory/gaussian_trajectory.h"
#include "nodes/trajectory/speak_gaussian.h"
#include "nodes/trajectory/speech_targets.h"

namespace face::mmm {

Timeline speak_path(const Phones& phones, const PhoneStatistics& statistics, engine::SeqWriter<Weights>& weights,
                    const SpeakPathOptions& options) {
  check(!phones.phones.empty(), "there are no phones to speak");
  check(options.steps >= 1, "steps is ", options.steps, ", expected at least 1");
  const std::size_t dims = statistics.all.mean.size(), count = trajectory::frame_count(phones, options.rate_hz);
  const auto steps = static_cast<std::size_t>(options.steps);
  check(dims > 0, "the statistics are of no animation parameters");
  Timeline timeline;
  for (std::size_t t = 0; t < count; ++t) timeline.time_s.push_back(static_cast<double>(t) / options.rate_hz);
  timeline.duration_s = static_cast<double>(count) / options.rate_hz;

  const std::vector<std::string> labels = spoken_labels(phones);
  std::vector<const PhoneStatistic*> used;
  for (const std::string& label : labels) {
    used.push_back(&trajectory::find_statistic(statistics, label));
    check(used.back()->mean.size() == dims && used.back()->covariance.size() == dims * dims, "the statistic of \"",
          used.back()->label, "\" has ", used.back()->mean.size(), " means and ", used.back()->covariance.size(),
          " covariances, expected ", dims, " and ", dims * dims);
  }
  const SpokenSteps spoken =
      spoken_steps(phones, step_times(timeline.time_s, timeline.duration_s, steps), options.hold_closures);
  const double smoothness =
      trajectory::smoothness_at(options.smoothness, 30, options.rate_hz * static_cast<double>(steps));
  trajectory::TrajectoryTargets targets{count * steps, dims, {}, {}};
  for (std::size_t t = 0; t < count * steps; ++t) {
    const PhoneStatistic& phone = *used[spoken.phone[t]];
    const double pull = spoken.held[t] ? held_pull * (1 + smoothness) : 1;
    for (std::size_t k = 0; k < dims; ++k) {
      const double variance = phone.covariance[k * dims + k];
      check(variance > 0, "the statistic of \"", phone.label, "\" has a variance of ", variance,
            ", expected more than 0");
      targets.precision.push_back(pull / variance);
      targets.target.push_back(phone.mean[k]);
    }
  }
  const std::vector<double> values = trajectory::solve_trajectory(targets, smoothness);
  for (std::size_t t = 0; t < count; ++t) {
    Weights frame;
    for (std::size_t k = 0; k < dims; ++k) frame.values.push_back(static_cast<float>(values[t * steps * dims + k]));
    weights.push(std::move(frame));
  }
  return timeline;
}

}  // namespace face::mmm
