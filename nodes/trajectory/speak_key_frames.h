// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"
#include "nodes/types/visemes.h"
#include "nodes/types/weights.h"

namespace face::trajectory {

struct SpeakKeyFramesOptions {
  double rate_hz = 60;
};

// Speech by key frames, as Blanz, Basso, Poggio and Vetter make it (Reanimating Faces in Images and Video, 2003,
// section 4.2): the viseme of every phone is a key frame at its middle, and between two of them weights go from one to
// the other by (1 - cos(pi t)) / 2, which starts and stops gently. A diphthong has two key frames, in the middles of
// its parts. Before the first and after the last the face rests on them. Kept as published, to compare with: no
// coarticulation, no regard to how long a phone is, and a closure lasts for a moment only.
Timeline speak_key_frames(const Phones& phones, const Visemes& visemes, engine::SeqWriter<Weights>& weights,
                          const SpeakKeyFramesOptions& options = {});

}  // namespace face::trajectory
