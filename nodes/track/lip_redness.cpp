// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/lip_redness.h"

#include <algorithm>
#include <cmath>

namespace face::track {
namespace {

// Red less green, in levels of 0 to 255: luma is the weighted mean of the three.
double redness_of(const LipColour& colour) {
  constexpr double red = 0.299, green = 0.587, blue = 0.114, shift = 8;  // of FaceColours
  const double red_to_green = std::exp(colour[0]), blue_to_green = std::exp(colour[1]);
  const double level = (255 * colour[2] + shift) / (red * red_to_green + green + blue * blue_to_green);
  return level * (red_to_green - 1);
}

}  // namespace

LipRedness lip_redness(const std::vector<LipColour>& line) {
  // Levels below which it is noise and coding, and at which it counts for half.
  constexpr double least_redness = 4, half_redness = 8;
  std::vector<double> levels;
  for (const LipColour& colour : line) levels.push_back(redness_of(colour));
  const double lips = std::max(
      least_redness, std::min(mean_between(levels, lip_from, lip_to), mean_between(levels, 1 - lip_to, 1 - lip_from)));
  LipRedness result;
  result.trust = lips * lips / (lips * lips + half_redness * half_redness);
  for (const double level : levels) result.pale.push_back(std::clamp(1 - level / lips, 0.0, 1.0));
  return result;
}

double pale_share(const LipRedness& redness) {
  double sum = 0;
  for (std::size_t i = 0; i < redness.pale.size(); ++i)
    if (place_on_line(i) >= lip_line_edge && place_on_line(i) <= 1 - lip_line_edge) sum += redness.pale[i];
  return sum / lip_line_samples;
}

}  // namespace face::track
