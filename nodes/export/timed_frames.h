// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "nodes/types/timeline.h"

namespace face::exports {

// Throws unless there is at least one frame, the timeline has a time for each, and times ascend from 0 or later up to
// its duration.
void check_frames(std::size_t frame_count, const Timeline& timeline);

}  // namespace face::exports
