// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/phone_statistics.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::mmm {

struct RefineSpeakerOptions {
  double smoothness = 3;  // of the paths that are spoken with it, at 30 frames per second
  std::int64_t steps = 8;
  bool hold_closures = true;
  double restraint = 0.5;  // frames that a phone's plain mean counts for
};

// Means of the phones so that the spoken path, not the phones' middle, comes near the frames (Ezzat, Geiger, Poggio,
// Trainable Videorealistic Speech Animation, SIGGRAPH 2002, section 5.3, trains means and variances by gradient descent
// on that error). A path through plain means stays far from short sounds that their neighbours pull away, and from
// closed lips in between open ones.
// Differs from the paper: only means change, and they are found at once: for given variances the path of
// mmm.speak_path is linear in them, x = A mu, so that the best are the least squares
// solution of |x - A mu|^2 + restraint |mu - mu_plain|^2. The silence at both ends gets a statistic of its own
// ("SIL.edge", see spoken_steps.h). smoothness, steps, hold_closures: those of the paths that will be spoken.
// weights: of the frames, empty where there are none. statistics: of trajectory.train_phones on the same; labels that
// no frame has stay as they are.
PhoneStatistics refine_speaker(const engine::Seq<Weights>& weights, const Timeline& timeline, const Phones& phones,
                               const PhoneStatistics& statistics, const RefineSpeakerOptions& options = {});

}  // namespace face::mmm
