// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/retime_weights.h"

#include <algorithm>

#include "nodes/base/check.h"

namespace face::model {

void retime_weights(const engine::Seq<Weights>& weights, const Timeline& timeline, const Timeline& clip,
                    engine::SeqWriter<Weights>& retimed, const RetimeWeightsOptions& options) {
  check(weights.size() == timeline.time_s.size(), "there are ", weights.size(), " weights, but their timeline has ",
        timeline.time_s.size(), " moments");
  check(!weights.empty(), "there are no weights");
  for (const double frame_s : clip.time_s) {
    const double time_s = frame_s - options.delay_s;
    const auto after = std::upper_bound(timeline.time_s.begin(), timeline.time_s.end(), time_s);
    const std::size_t high =
        std::min(static_cast<std::size_t>(after - timeline.time_s.begin()), timeline.time_s.size() - 1);
    const std::size_t low = after == timeline.time_s.begin()
                                ? 0
                                : std::min(high, static_cast<std::size_t>(after - timeline.time_s.begin()) - 1);
    const double span_s = timeline.time_s[high] - timeline.time_s[low];
    const auto t =
        static_cast<float>(span_s > 0 ? std::clamp((time_s - timeline.time_s[low]) / span_s, 0.0, 1.0) : 0.0);
    const auto first = weights.at(low), second = weights.at(high);
    Weights frame = *first;
    frame.values.resize(std::max(first->values.size(), second->values.size()), 0.0f);
    for (std::size_t k = 0; k < frame.values.size(); ++k) {
      const float target = k < second->values.size() ? second->values[k] : 0.0f;
      frame.values[k] += t * (target - frame.values[k]);
    }
    retimed.push(std::move(frame));
  }
}

}  // namespace face::model
