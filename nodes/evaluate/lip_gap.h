// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/phones.h"
#include "nodes/types/rig.h"
#include "nodes/types/table.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::evaluate {

struct LipGapOptions {
  double closed_mm = 1;  // a lip gap up to this is a closed mouth, a distance up to this is lip on teeth
};

struct LipGapResult {
  Table table;   // rows "own" and, with a truth, "truth"
  Table frames;  // a row per frame: own_gap_mm and, with a truth, truth_gap_mm
};

// Whether lips close when they must. g(t) is the mean over Rig::inner_lips of the distance along the jaw axis, minus
// the neutral's, linear between frames. A bilabial (P, B, M) lasts from c0 to c1: the closure of a split stop ("P.c"),
// else the whole phone. No field standard exists; the definitions are ours:
//   closures            bilabials that are wholly within the animation
//   closure_percent     share of them with min g <= closed_mm
//   closure_error_mm    mean of max(0, min g - closed_mm)
//   closure_late_ms     mean of (time of min g) - (c0 + c1) / 2; where g is least for a while, its middle
//   closure_offset_ms   mean size of the same
//   penetration_mm      mean over frames of max(0, -g); deepest_mm: the largest of them
//   open_vowels         AA AE AO AW AY EH
//   false_closed_percent  share of their centres with g <= closed_mm
//   labiodentals        F and V; contact_percent: share whose smallest distance of lower lip to upper teeth in a frame
//                       (at least the one nearest to the middle) is <= closed_mm; contact_error_mm: mean excess over it
//   gap_error_mm        RMS of g minus the truth's g over frames; NaN without a truth
// NaN where there is nothing to count, as in a rig that names no teeth. truth may be null.
LipGapResult lip_gap(const Rig& rig, const engine::Seq<Weights>& weights, const engine::Seq<Weights>* truth,
                     const Phones& phones, const Timeline& timeline, const LipGapOptions& options = {});

}  // namespace face::evaluate
