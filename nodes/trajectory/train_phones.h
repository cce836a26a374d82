// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/phone_statistics.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::trajectory {

struct TrainPhonesOptions {
  double least_sigma = 0.02;       // standard deviation that no direction falls below
  std::int64_t prior_frames = 10;  // frames of all speech that every phone is mixed with
  double closing_s =
      0;  // for parameters that are 0 where the mouth is shut: time in which lips shut and part; 0 = none
};

// Mean and covariance of the animation parameters over the frames of every phone (Animating Lip-Sync Speech Faces,
// section 7). A frame belongs to the phone at its middle; frames without weights (tracking lost) are left out. Closure
// and release of a stop are two phones, as their labels are.
// Differs from the paper: a phone's covariance is mixed with the one of all speech as if prior_frames frames of it had
// been seen, and no direction's deviation falls below least_sigma, so that rare phones have covariances that can be
// inverted. Statistics of all frames stand for phones that were never seen. With closing_s, frames in which a P, B or M
// shuts the lips by a share s (lips_shut.h) are taken to be 1 - s of what their phone wants, x = (1 - s) mu (least
// squares): an A between two B is half shut in most of its frames, and a plain mean of these would shut every A. Where
// s is above 0.9 they say nothing; a phone that has no others keeps its plain mean.
PhoneStatistics train_phones(const engine::Seq<Weights>& weights, const Timeline& timeline, const Phones& phones,
                             const TrainPhonesOptions& options = {});

}  // namespace face::trajectory
