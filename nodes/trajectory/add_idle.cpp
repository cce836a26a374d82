// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/add_idle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/random.h"
#include "nodes/types/arkit.h"

namespace face::trajectory {
namespace {

constexpr double close_s = 0.11, shut_s = 0.03, open_s = 0.18;
// Eyes jump in 50 ms and rest for 0.8 to 2.5 s.
constexpr double jump_s = 0.05;
constexpr double quantum = 1.0 / 4096;

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

struct Gaze {
  double start_s, left, up;  // in [-1, 1]
};

std::vector<double> blink_starts(const AddIdleOptions& options, double duration_s) {
  Random random(static_cast<std::uint64_t>(options.seed), 1);
  std::vector<double> starts;
  for (double t = random.uniform(0.5, 0.5 + options.blink_least_s); t < duration_s;
       t += random.uniform(options.blink_least_s, options.blink_most_s))
    starts.push_back(t);
  return starts;
}

std::vector<Gaze> gaze_changes(const AddIdleOptions& options, double duration_s) {
  Random random(static_cast<std::uint64_t>(options.seed), 2);
  std::vector<Gaze> gazes = {{-1, 0, 0}};
  for (double t = random.uniform(0.8, 2.5); t < duration_s; t += random.uniform(0.8, 2.5))
    gazes.push_back({t, random.uniform(-1, 1), random.uniform(-0.6, 0.6)});
  return gazes;
}

double lid_at(const std::vector<double>& starts, double time_s) {
  double lid = 0;
  for (const double start_s : starts) {
    const double t = time_s - start_s;
    if (t > 0 && t < close_s + shut_s + open_s)
      lid = std::max(lid, std::min(smooth(t / close_s), smooth((close_s + shut_s + open_s - t) / open_s)));
  }
  return lid;
}

Gaze gaze_at(const std::vector<Gaze>& gazes, double time_s) {
  std::size_t i = 0;
  while (i + 1 < gazes.size() && gazes[i + 1].start_s <= time_s) ++i;
  if (i == 0) return gazes[0];
  const double share = smooth((time_s - gazes[i].start_s) / jump_s);
  return {time_s, gazes[i - 1].left + share * (gazes[i].left - gazes[i - 1].left),
          gazes[i - 1].up + share * (gazes[i].up - gazes[i - 1].up)};
}

// 0 to 1: two slow waves whose periods do not repeat together.
double brow_at(const AddIdleOptions& options, double time_s) {
  Random random(static_cast<std::uint64_t>(options.seed), 3);
  const double first = random.uniform(0, 2 * std::numbers::pi), second = random.uniform(0, 2 * std::numbers::pi);
  const double wave =
      std::sin(2 * std::numbers::pi * time_s / 3.1 + first) + std::sin(2 * std::numbers::pi * time_s / 4.7 + second);
  return std::max(0.0, wave / 2);
}

}  // namespace

void add_idle(const engine::Seq<Weights>& weights, const Timeline& timeline, engine::SeqWriter<Weights>& idle_weights,
              const AddIdleOptions& options) {
  check(weights.size() == timeline.time_s.size(), "there are ", weights.size(), " frames of weights and ",
        timeline.time_s.size(), " in the timeline");
  check(options.blink_least_s > 0 && options.blink_most_s >= options.blink_least_s, "blinks are to come every ",
        options.blink_least_s, " to ", options.blink_most_s, " s, expected more than 0 and the larger last");
  check(std::isfinite(timeline.duration_s), "the timeline lasts ", timeline.duration_s, " s, expected a finite time");
  const std::vector<double> blinks = blink_starts(options, timeline.duration_s);
  const std::vector<Gaze> gazes = gaze_changes(options, timeline.duration_s);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    Weights frame = *weights.at(i);
    check(frame.values.size() >= arkit_count, "frame ", i, " has ", frame.values.size(), " weights, expected ",
          arkit_count);
    const auto raise = [&](std::string_view name, double value) {
      float& weight = frame.values[arkit_index(name)];
      weight = std::max(weight, static_cast<float>(std::round(std::clamp(value, 0.0, 1.0) / quantum) * quantum));
    };
    const double time_s = timeline.time_s[i], lid = options.blink * lid_at(blinks, time_s);
    const Gaze gaze = gaze_at(gazes, time_s);
    const double brow = options.brow * brow_at(options, time_s);
    raise("eyeBlinkLeft", lid);
    raise("eyeBlinkRight", lid);
    raise("eyeLookOutLeft", options.gaze * gaze.left);
    raise("eyeLookInRight", options.gaze * gaze.left);
    raise("eyeLookInLeft", -options.gaze * gaze.left);
    raise("eyeLookOutRight", -options.gaze * gaze.left);
    for (const std::string_view side : {"Left", "Right"}) {
      raise(std::string("eyeLookUp").append(side), options.gaze * gaze.up);
      raise(std::string("eyeLookDown").append(side), -options.gaze * gaze.up);
      raise(std::string("browOuterUp").append(side), brow);
    }
    raise("browInnerUp", brow);
    idle_weights.push(weights.id(i), std::move(frame));
  }
}

}  // namespace face::trajectory
