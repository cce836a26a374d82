// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace face {

// What the face does for one phone: a Gaussian around target weights, and what must touch.
struct Viseme {
  std::string label;                 // ARPAbet without stress, "SIL", or one half of a stop ("P.c", "P.r")
  std::vector<float> weights;        // 52, ARKit order, [0, 1]
  std::vector<float> glide_weights;  // 52 or empty: where a diphthong goes in its second part
  std::vector<float> sigmas;         // 52, > 0: how far from the target a weight may stay; small = must be reached
  double glide_from = 1;             // share of the phone's length at which the second part begins
  std::string contact;               // "lips", "teeth" (lower lip on upper teeth) or empty
  double open_mm = 0;                // smallest lip gap at the middle of the phone where it is long enough; 0 = any
};

// One viseme per phone.
struct Visemes {
  std::vector<Viseme> visemes;
};

}  // namespace face
