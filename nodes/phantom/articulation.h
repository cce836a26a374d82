// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/phantom/perform_table.h"
#include "nodes/types/phones.h"

namespace face::phantom {

// How one speaker articulates.
struct SpeakerStyle {
  double reach_s = 0.075;      // time over which a segment's dominance falls to 1/e, before it
  double carry_s = 0.065;      // and after it
  double jaw = 1, lips = 1;    // gains
  double close_s = 0.070;      // time that lips or lip and teeth take to meet
  double release_s = 0.055;    // and to part
  double press = 0.35;         // of shut lips
  double left = 1, right = 1;  // gains of the sides of the mouth
  double smile = 0.05;         // always there
};

// A random speaker; amount 0 is the average one.
SpeakerStyle speaker_style(std::int64_t seed, double amount);

// What the mouth does at one time.
struct Articulation {
  Gestures gestures = {};
  double lips_shut = 0;  // 1 while the lips must touch
  double lip_teeth = 0;  // 1 while the lower lip must touch the upper teeth
};

// The gestures of an utterance over time.
class Articulator {
 public:
  // Throws where a label is not in the table.
  Articulator(const Phones& phones, const SpeakerStyle& style);
  Articulation at(double time_s) const;
  std::size_t closure_count() const { return closures_.size(); }
  std::size_t labiodental_count() const { return labiodentals_.size(); }

 private:
  // A segment, or half of a diphthong.
  struct Segment {
    double middle_s, plateau_s;  // dominance is full within plateau_s of the middle
    Gestures target;
    Gestures dominance;
  };
  struct Hold {
    double start_s, end_s;
  };
  double contact(const std::vector<Hold>& holds, double time_s) const;

  SpeakerStyle style_;
  std::vector<Segment> segments_;
  std::vector<Hold> closures_, labiodentals_;
};

}  // namespace face::phantom
