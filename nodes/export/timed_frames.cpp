// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/timed_frames.h"

#include "nodes/base/check.h"

namespace face::exports {

void check_frames(std::size_t frame_count, const Timeline& timeline) {
  check(frame_count > 0, "there are no frames to export");
  check(timeline.time_s.size() == frame_count, "there are ", frame_count, " frames, but the timeline has ",
        timeline.time_s.size(), " times");
  for (std::size_t i = 0; i < frame_count; ++i) {
    const double low_s = i == 0 ? 0.0 : timeline.time_s[i - 1];
    const bool ascends = i == 0 ? timeline.time_s[i] >= low_s : timeline.time_s[i] > low_s;
    check(ascends, "frame ", i, " of the timeline is at ", timeline.time_s[i], " s, expected ",
          i == 0 ? "at least " : "more than ", low_s, " s");
  }
  check(timeline.duration_s > timeline.time_s.back(), "the timeline ends at ", timeline.duration_s,
        " s, expected after its last frame at ", timeline.time_s.back(), " s");
}

}  // namespace face::exports
