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
};

// Mean and covariance of the animation parameters over the frames of every phone (Animating Lip-Sync Speech Faces,
// section 7). A frame belongs to the phone at its middle; frames without weights (tracking lost) are left out. Closure
// and release of a stop are two phones, as their labels are.
// Differs from the paper: a phone's covariance is mixed with the one of all speech as if prior_frames frames of it had
// been seen, and no direction's deviation falls below least_sigma, so that rare phones have covariances that can be
// inverted. Statistics of all frames stand for phones that were never seen.
PhoneStatistics train_phones(const engine::Seq<Weights>& weights, const Timeline& timeline, const Phones& phones,
                             const TrainPhonesOptions& options = {});

}  // namespace face::trajectory
