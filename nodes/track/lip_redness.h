// SPDX-License-Identifier: Apache-2.0
// What is as red as a lip, in whatever light. Internal to the area.
#pragma once
#include <vector>

#include "nodes/track/lip_line.h"

namespace face::track {

// Along a line across the mouth.
struct LipRedness {
  std::vector<double> pale;  // of each sample, 0 to 1: how far short of the lips' redness it falls; teeth and hollow do
  double trust = 0;          // 0 to 1: how much that says; little where the lips are hardly red, as in a grey film
};

// Redness is red less green, as levels. A lip that is glossy, painted or half in the shade is as red as it is lit: a
// reflex adds white light, which is as much red as green (Shafer, Using Color to Separate Reflection Components, Color
// Research and Application 1985), and leaves the difference. Teeth are white and the hollow of a mouth is dark: neither
// has much of it. The lips are the line's ends; the less red one counts, the other may be in better light.
LipRedness lip_redness(const std::vector<LipColour>& line);

// The mean along the line of what is pale, without its ends, which blur into the skin.
double pale_share(const LipRedness& redness);

}  // namespace face::track
