// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/landmarks.h"

namespace face::track {

struct FindRestOptions {
  double from_share = 0.05;  // of the frames, by the height of the lips: thinner ones are pressed together
  double to_share = 0.2;     // and thicker ones are open
};

// The points of a face whose mouth is shut, when nobody knows which frame shows it: the mean of the frames whose outer
// lips (from lip_1 to lip_5 above, lip_11 to lip_7 below) are nearly as low as they get. A clip may begin in the
// middle of a word, so that its first frame says little. landmarks: of a head that stands still (stabilise). Frames
// with a lost point do not count; where all have one, the first frame is the result, valid or not. At least one frame.
Landmarks find_rest(const engine::Seq<Landmarks>& landmarks, const FindRestOptions& options = {});

}  // namespace face::track
