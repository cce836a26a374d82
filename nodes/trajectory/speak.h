// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/trajectory/speech_targets.h"
#include "nodes/types/phones.h"
#include "nodes/types/rig.h"
#include "nodes/types/timeline.h"
#include "nodes/types/visemes.h"
#include "nodes/types/weights.h"

namespace face::trajectory {

struct SpeakOptions {
  double rate_hz = 60;
  double smoothness = 6;  // lambda at 30 frames per second; 10 in the paper, whose data were smoother
  double strength = 1;
  Normalise normalise = Normalise::none;
};

struct SpeakResult {
  Timeline timeline;
  double worst_closure_mm = 0;     // largest of the closures' smallest lip gaps
  double deepest_overlap_mm = 0;   // how far the lips run into each other where they do so most; 0 = never
  double worst_teeth_mm = 0;       // largest of the labiodentals' smallest distances of lower lip to upper teeth
  std::int64_t contact_count = 0;  // closures, labiodentals and open vowels that were asked for
  std::int64_t missed_count = 0;   // of these, those that this rig could not make
};

// Turns phones into the 52 ARKit weights of every frame: the smoothest curve through Gaussian targets (Ezzat, Geiger
// and Poggio, Trainable Videorealistic Speech Animation, SIGGRAPH 2002) with what the published systems miss as bounds
// on the rig's own geometry in mm: lips meet in every P B M, the lower lip meets the upper teeth in every F V, long
// open vowels are open, and lips never run into each other. Smoothness is per time: the same curve at every frame rate.
// Differs from the paper: targets and widths come from a table instead of statistics of recordings, diagonal
// covariance. Weights are rounded to 1/4096: a change of one word fades out over the frames around it, and rounding
// makes the frames that are the same to the eye the same to the bit, so that nothing after them is made again.
SpeakResult speak(const Phones& phones, const Visemes& visemes, const Rig& rig, engine::SeqWriter<Weights>& weights,
                  const SpeakOptions& options = {});

}  // namespace face::trajectory
