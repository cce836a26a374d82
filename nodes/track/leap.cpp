// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "nodes/track/mouth_shape.h"
#include "nodes/track/steps.h"

namespace face::track {

std::vector<Sighting> leap(const Knowledge& known, const Grey& now, const Image& patches,
                           std::vector<Sighting> places) {
  if (known.bonds.modes.empty()) return places;
  const std::vector<double>& fall = known.bonds.modes[lower_lip_mode];
  std::vector<std::size_t> marks;
  double farthest = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!known.is_dot(i) || std::hypot(fall[2 * i], fall[2 * i + 1]) == 0) continue;
    marks.push_back(i);
    farthest = std::max(farthest, std::hypot(fall[2 * i], fall[2 * i + 1]));
  }
  constexpr std::size_t fewest = 3;
  constexpr double clear = 0.9;  // likeness of a dot that is there
  if (marks.size() < fewest) return places;
  // Dots that are seen where the lip went by `step` of a fall.
  const auto seen_at = [&](double step, double reach_px) {
    double seen = 0;
    for (const std::size_t i : marks)
      seen += search_patch(own_patch(known, patches, i), known.sides_px[i], now, places[i].x_px + step * fall[2 * i],
                           places[i].y_px + step * fall[2 * i + 1], reach_px)
                  .likeness >= clear;
    return seen;
  };
  const double reach_px = known.options.search_px, most_px = 0.5 * known.mouth_px;
  const double all = static_cast<double>(marks.size());
  double best_step = 0, best = seen_at(0, reach_px);
  for (double far_px = reach_px; far_px <= most_px && best < all; far_px += reach_px)
    for (const double sign : {1.0, -1.0}) {
      const double step = sign * far_px / farthest, seen = seen_at(step, reach_px);
      if (seen > best) best = seen, best_step = step;
    }
  for (const std::size_t i : marks) {
    places[i].x_px += best_step * fall[2 * i];
    places[i].y_px += best_step * fall[2 * i + 1];
  }
  return places;
}

}  // namespace face::track
