// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::trajectory {

struct AddIdleOptions {
  std::int64_t seed = 1;
  double blink_least_s = 2;  // from one blink's start to the next: uniform between these
  double blink_most_s = 5;
  double blink = 1;    // how far the lids close
  double brow = 0.08;  // largest lift of the brows, slowly up and down
  double gaze = 0.08;  // largest weight of the small eye movements
};

// Adds what a face does besides speaking: blinks, small eye movements, slow brows. Only eye and brow weights change,
// and what happens when depends on the time and the seed alone, so that a change of the speech changes no other frame.
// A weight that is there already stays where it is larger. Lids close in 110 ms and open in 180 ms (slow for a blink,
// but no frame at 60 Hz moves them by more than a quarter).
void add_idle(const engine::Seq<Weights>& weights, const Timeline& timeline, engine::SeqWriter<Weights>& idle_weights,
              const AddIdleOptions& options = {});

}  // namespace face::trajectory
