// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/audio.h"
#include "nodes/types/table.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::evaluate {

struct SyncOptions {
  double loud_db = -30;  // below the loudest 10 ms: from here on it is sound
  double moved = 0.03;   // a weight of the mouth or jaw that differs by this from the first frame has moved
};

// When sound and mouth begin. audio_onset_s: start of the first 10 ms whose RMS is within loud_db of the loudest 10 ms.
// first_move_s: the first frame in which a weight of jaw, mouth, cheeks' puff or tongue differs from frame 0 by more
// than `moved`. late_ms: movement minus sound (lips that shut before a word begins give a negative one), sync_ms: its
// size. NaN where there is no sound, or nothing moves.
Table sync(const Audio& audio, const engine::Seq<Weights>& weights, const Timeline& timeline,
           const SyncOptions& options = {});

}  // namespace face::evaluate
