// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak_key_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/trajectory/speech_targets.h"

namespace face::trajectory {
namespace {

struct KeyFrame {
  double time_s = 0;
  const std::vector<float>* weights = nullptr;
};

}  // namespace

Timeline speak_key_frames(const Phones& phones, const Visemes& visemes, engine::SeqWriter<Weights>& weights,
                          const SpeakKeyFramesOptions& options) {
  check(options.rate_hz > 0, "rate_hz is ", options.rate_hz, ", expected more than 0");
  std::vector<KeyFrame> keys;
  for (std::size_t p = 0; p < phones.phones.size(); ++p) {
    const Phone& phone = phones.phones[p];
    const Viseme& viseme = find_viseme(visemes, phone.label, p);
    const double length_s = phone.end_s - phone.start_s;
    const double from = viseme.glide_weights.empty() ? 1 : viseme.glide_from;
    keys.push_back({phone.start_s + 0.5 * from * length_s, &viseme.weights});
    if (!viseme.glide_weights.empty())
      keys.push_back({phone.start_s + 0.5 * (from + 1) * length_s, &viseme.glide_weights});
  }
  check(!keys.empty(), "there are no phones");
  Timeline timeline;
  timeline.duration_s = phones.duration_s;
  const std::size_t frames = frame_count(phones, options.rate_hz);
  std::size_t next = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const double time_s = static_cast<double>(f) / options.rate_hz;
    timeline.time_s.push_back(time_s);
    while (next < keys.size() && keys[next].time_s <= time_s) ++next;
    const KeyFrame& before = keys[next == 0 ? 0 : next - 1];
    const KeyFrame& after = keys[std::min(next, keys.size() - 1)];
    const double span_s = after.time_s - before.time_s;
    const double t = span_s > 0 ? std::clamp((time_s - before.time_s) / span_s, 0.0, 1.0) : 0.0;
    const auto ease = static_cast<float>(0.5 * (1 - std::cos(std::numbers::pi * t)));
    Weights frame{*before.weights};
    for (std::size_t k = 0; k < std::min(frame.values.size(), after.weights->size()); ++k)
      frame.values[k] += ease * ((*after.weights)[k] - frame.values[k]);
    weights.push(std::move(frame));
  }
  return timeline;
}

}  // namespace face::trajectory
