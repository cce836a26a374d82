// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/landmarks.h"

namespace face::track {

struct FindRestOptions {
  double from_share = 0.05;   // of the frames, by the height of the lips: thinner ones are pressed together
  double to_share = 0.33;     // and thicker ones are open
  double still_share = 0.05;  // of all frames: so many of these, those in which the mouth moves least; 1 = all of them
};

// The points of a face whose mouth is shut, when nobody knows which frame shows it: the mean of the frames whose outer
// lips (from lip_1 to lip_5 above, lip_11 to lip_7 below; 49 to 53 and 59 to 55 of Multi-PIE) are low, and in which the
// mouth is stillest: a mouth that is pressed together in speech is lower than one at rest, but not for long. (The speed
// of a frame: root mean square distance of its lips to those two frames before and after; with fewer neighbours, to
// those that are there.) A clip may begin in the middle of a word, so that its first frame says little. landmarks: of a
// head that stands still (stabilise). Frames that lost a point of the lips do not count; where all have, the first
// frame is the result, valid or not. Other points are the mean over those of these frames that see them; where none
// does, of all of them. At least one frame.
Landmarks find_rest(const engine::Seq<Landmarks>& landmarks, const FindRestOptions& options = {});

}  // namespace face::track
