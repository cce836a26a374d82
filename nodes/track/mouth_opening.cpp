// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/mouth_opening.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/base/find_landmark.h"
#include "nodes/track/lip_line.h"
#include "nodes/track/lip_redness.h"

namespace face::track {
namespace {

// Mean distance of the brightness from that of the lips, which turns evenly from the upper one's into the lower one's,
// as a share of the lips'.
double uneven_share(const std::vector<double>& luma) {
  constexpr double middle = (lip_from + lip_to) / 2;
  const double above = mean_between(luma, lip_from, lip_to), below = mean_between(luma, 1 - lip_to, 1 - lip_from);
  double sum = 0;
  for (std::size_t i = 0; i < luma.size(); ++i) {
    const double place = place_on_line(i);
    if (place < lip_line_edge || place > 1 - lip_line_edge) continue;
    const double share = std::clamp((place - middle) / (1 - 2 * middle), 0.0, 1.0);
    sum += std::abs(luma[i] - above - share * (below - above));
  }
  return sum / lip_line_samples / std::max(0.02, (above + below) / 2);
}

// What a mouth's height is held against. Not its width, where the eyes are seen: lips that meet in a pout are as thick
// as others, on a narrower mouth.
double usual_width_px(const Landmarks& landmarks, const MouthWidth& width) {
  constexpr double mouth_of_eyes = 1.5;  // widths of the mouth in distances of the inner corners of the eyes
  const Landmark *right = find_landmark(landmarks, "eye_inner_r"), *left = find_landmark(landmarks, "eye_inner_l");
  if (!right || !left || !right->valid || !left->valid) return width.length_px();
  return mouth_of_eyes * distance_px(*right, *left);
}

}  // namespace

double mouth_opening(const Matrix& seen, const Landmarks& landmarks) {
  const MouthWidth width = mouth_width(landmarks);
  const LipLine line = lip_line(landmarks, 3);
  const LipLine corners = {find_landmark(landmarks, "lip_0"), find_landmark(landmarks, "lip_6")};
  if (!line.upper->valid || !line.lower->valid || !corners.upper->valid || !corners.lower->valid) return -1;
  const std::vector<LipColour> colours = colours_of_line(seen, 2);
  std::vector<double> luma;
  for (const LipColour& colour : colours) luma.push_back(colour[2]);
  const double height_px = std::hypot(line.lower->x_px - line.upper->x_px, line.lower->y_px - line.upper->y_px);
  const double height = height_px / std::max(1.0, usual_width_px(landmarks, width));
  // Of brightness lips that meet have 0.03, open ones a half more; of redness three times as much is open: its power.
  constexpr double meeting = 0.03, usual = 0.01, power = 3.5;
  const double uneven = uneven_share(luma) * height;
  const double by_light = std::min(uneven, usual * std::pow(uneven / meeting, power));
  const LipRedness redness = lip_redness(colours);
  return redness.trust * pale_share(redness) * height + (1 - redness.trust) * by_light;
}

}  // namespace face::track
