// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/sync.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/statistics.h"
#include "nodes/types/arkit.h"

namespace face::evaluate {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double onset_s(const Audio& audio, double loud_db) {
  check(std::isfinite(audio.rate_hz) && audio.rate_hz > 0, "audio has a rate of ", audio.rate_hz,
        " Hz, expected more than 0");
  const auto block = static_cast<std::size_t>(std::max(1.0, audio.rate_hz / 100));
  std::vector<double> power;
  for (std::size_t first = 0; first + block <= audio.samples.size(); first += block) {
    double sum = 0;
    for (std::size_t i = first; i < first + block; ++i) {
      check(std::isfinite(audio.samples[i]), "audio: sample ", i, " is ", audio.samples[i],
            ", expected a finite number");
      sum += double{audio.samples[i]} * audio.samples[i];
    }
    power.push_back(sum);
  }
  const double loudest = power.empty() ? 0 : largest_of(power);
  if (loudest == 0) return nothing;
  std::size_t first = 0;
  while (power[first] < loudest * std::pow(10, loud_db / 10)) ++first;
  return static_cast<double>(first * block) / audio.rate_hz;
}

bool of_the_mouth(std::size_t shape) {
  const std::string_view name = arkit_names[shape];
  return name.starts_with("jaw") || name.starts_with("mouth") || name == "cheekPuff" || name == "tongueOut";
}

double value_of(const Weights& weights, std::size_t shape) {
  return shape < weights.values.size() ? weights.values[shape] : 0;
}

}  // namespace

Table sync(const Audio& audio, const engine::Seq<Weights>& weights, const Timeline& timeline,
           const SyncOptions& options) {
  check(!weights.empty(), "weights has no frames to judge");
  check_times(weights.size(), timeline, "weights");
  const double sound_s = onset_s(audio, options.loud_db);
  const auto rest = weights.at(0);
  double move_s = nothing;
  std::size_t frame = 0;
  for (const Weights& pose : weights) {
    bool moves = false;
    for (std::size_t s = 0; s < arkit_count; ++s) {
      const double value = value_of(pose, s);
      check(std::isfinite(value), "weights of frame ", weights.id(frame), ": weight ", s, " is ", value,
            ", expected a finite number");
      moves = moves || (of_the_mouth(s) && std::abs(value - value_of(*rest, s)) > options.moved);
    }
    if (moves && std::isnan(move_s)) move_s = timeline.time_s[frame];
    ++frame;
  }
  const double late_ms = 1000 * (move_s - sound_s);
  return one_row("all", {"audio_onset_s", "first_move_s", "late_ms", "sync_ms"},
                 {sound_s, move_s, late_ms, std::abs(late_ms)});
}

}  // namespace face::evaluate
