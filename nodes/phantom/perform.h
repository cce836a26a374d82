// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "engine/port.h"
#include "nodes/types/phones.h"
#include "nodes/types/rig.h"
#include "nodes/types/rigid_motion.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"

namespace face::phantom {

struct PerformOptions {
  double rate_hz = 60;  // where no timeline is given
  std::int64_t seed = 1;
  double strength = 1;     // of articulation; below 1 mumbles
  double style = 1;        // how far the speaker of this seed departs from the average one
  double blink = 1;        // how far the lids close
  double brows = 1;        // of brow movements
  double gaze = 1;         // of eye movements
  double head_motion = 1;  // of head movements
  double turn_deg = 0;     // the head turns this far to both sides as well, its left first
  double turn_s = 4;       // from the middle over both sides and back
};

struct PerformResult {
  Timeline timeline;
  std::int64_t closure_count = 0;      // bilabials
  std::int64_t labiodental_count = 0;  // F and V
  double labiodental_distance_mm = 0;  // lower lip to upper teeth while they last; 0 without a rig that tells it
};

// Acts out speech: the true weights of every frame and the motion of the head, for data whose truth must be known.
// Lips, jaw and tongue follow dominance functions (Cohen and Massaro, Modeling Coarticulation in Synthetic Visual
// Speech, in Models and Techniques in Computer Animation, 1993, eqs. 1-4) over a phone table of its own
// (perform_table.h). Lips are exactly closed throughout every P, B and M: with a rig its mean lip gap is 0; without one
// mouthClose equals jawOpen. F and V bring the lower lip to the upper teeth. Beside speech: blinks, brows raised and
// head nodded with prominent vowels, saccades that hold a point while the head moves, head sway.
//
// Everything is a function of time: the same pose at the same time for any rate or timeline. It shares no code and no
// table with the trajectory area, which it judges.
// Differs from the paper: distances count from the edge of the middle part of a segment, and an exponent of 1.4 makes
// curves smooth there; contacts are imposed over the blend.
// phones: labels ARPAbet without stress, stops split ("P.c", "P.r") or whole. timeline: may be null. rig: may be null.
// take: its name, by which the takes of one speaker differ in all that is beside speech; null = the seed's alone, so
// that all blink and sway at the same times.
PerformResult perform(const Phones& phones, const Timeline* timeline, const Rig* rig, const std::string* take,
                      engine::SeqWriter<Weights>& weights, engine::SeqWriter<RigidMotion>& world_from_head,
                      const PerformOptions& options = {});

}  // namespace face::phantom
