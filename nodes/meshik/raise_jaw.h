// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/landmarks.h"
#include "nodes/types/rig.h"
#include "nodes/types/visemes.h"

namespace face::meshik {

struct RaiseJawOptions {
  double highest_share = 0.01;  // of the frames: so many may have the jaw above the rest
  double most = 0.15;           // how far the jaw is raised at most, in weights of the rig's jawOpen
  int max_lost = 3;             // frames that lost more landmarks do not count
  int rest_frames = 12;         // so many in a row with the mouth as it is in `rest` are a rest
};

// The landmarks of a mouth at rest, from those of a shut mouth and of everything that was said. Nobody rests in the
// middle of speech: the mouths that are found shut there (track.find_rest) are those of P, B and M, whose lips meet
// over a jaw that hangs some millimetres low. Counted from these, every mouth would come out as much too high. The jaw
// of a head at rest is up, and no mouth has it higher: the weights of every frame are found as for key shapes
// (sculpt_keys.h), with jawOpen and mouthClose that may be below 0, and where the highest frames have the jaw is where
// it rests. (Of jawOpen over time, the median of three frames; at least two frames may be above the result.) The jaw of
// `rest` is raised by as much with lips that stay together: jawOpen and mouthClose in the proportion that leaves the
// middle of the rig's lips where they are. rest comes back as it is where no frame has the jaw higher, where the rig
// has no jawOpen or no mouthClose, and where somebody does rest: where the lips keep the shape that they have in it (to
// a 40th of the mouth's width, root mean square) for rest_frames and longer, in a 40th of all frames and more
// (one closure hardly lasts so long; in ten minutes some that follow each other do). landmarks: of a head that stands
// still (track.stabilise), as those of rest.
Landmarks raise_jaw(const Rig& rig, const engine::Seq<Landmarks>& landmarks, const Landmarks& rest,
                    const Visemes* visemes, const RaiseJawOptions& options = {});

}  // namespace face::meshik
