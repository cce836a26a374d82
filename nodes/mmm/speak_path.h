// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/phone_statistics.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::mmm {

struct SpeakPathOptions {
  double rate_hz = 30;
  double smoothness = 3;  // at 30 frames per second
  std::int64_t steps = 8;
  bool hold_closures = true;
};

// Speech as a path through a speaker's Gaussians (Ezzat, Geiger, Poggio, Trainable Videorealistic Speech Animation,
// SIGGRAPH 2002, section 5.2): (x - mu)' Sigma^-1 (x - mu) + smoothness |x_t - x_(t-1)|^2, diagonal covariance.
// Differs from the paper and from trajectory.speak_gaussian: the path is found at `steps` steps of a frame, so that
// phones pull for as long as they last; and lips stay shut all through P, B and M (spoken_steps.h), because a mean of
// frames leaves them open. statistics: of refine_speaker, with the same smoothness, steps and hold_closures; labels it
// does not have are looked for as trajectory::find_statistic does.
Timeline speak_path(const Phones& phones, const PhoneStatistics& statistics, engine::SeqWriter<Weights>& weights,
                    const SpeakPathOptions& options = {});

}  // namespace face::mmm
