// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/phones.h"
#include "nodes/types/timeline.h"

namespace face::model {

struct JoinTakesResult {
  Phones phones;
  Timeline timeline;
};

// Speech and frames of several takes one after the other, as seq.flatten joins their frames: every take begins where
// the one before ends (at the later end of its speech and its frames; what is missing is silence). Words keep their
// takes apart only by that. phones, timelines: of every take, with the same ids. Warns of a take whose speech and frames
// differ in length by more than half a second: its sound is another take's, cut off, or at another rate.
JoinTakesResult join_takes(const engine::Seq<Phones>& phones, const engine::Seq<Timeline>& timelines,
                           engine::Progress& progress);

}  // namespace face::model
