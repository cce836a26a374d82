// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "nodes/track/mouth_shape.h"
#include "nodes/track/steps.h"

namespace face::track {

Leap leap(const Knowledge& known, const Grey& now, const Image& patches, std::vector<Sighting> places) {
  Leap result{std::move(places), {}};
  result.found.assign(result.places.size(), false);
  if (known.bonds.modes.empty()) return result;
  const std::vector<double>& fall = known.bonds.modes[lower_lip_mode];
  std::vector<std::size_t> marks;
  std::vector<std::size_t> others;  // those that do not fall
  double farthest = 0;
  for (std::size_t i = 0; i < result.places.size(); ++i) {
    if (!known.is_dot(i)) continue;
    if (std::hypot(fall[2 * i], fall[2 * i + 1]) == 0) {
      others.push_back(i);
      continue;
    }
    marks.push_back(i);
    farthest = std::max(farthest, std::hypot(fall[2 * i], fall[2 * i + 1]));
  }
  constexpr std::size_t fewest = 3;
  constexpr double clear = 0.9;  // likeness of a dot that is there
  constexpr double same_px = 3;  // nearer than two dots can be
  if (marks.size() < fewest) return result;
  const auto look_for = [&](std::size_t i, double step, double reach_px) {
    return search_patch(own_patch(known, patches, i), known.sides_px[i], now,
                        result.places[i].x_px + step * fall[2 * i], result.places[i].y_px + step * fall[2 * i + 1],
                        reach_px);
  };
  // Dots that are seen where the lip went by `step` of a fall, each another one.
  const auto seen_at = [&](double step, double reach_px) {
    std::vector<PatchMatch> seen;
    for (const std::size_t i : marks) {
      const PatchMatch match = look_for(i, step, reach_px);
      const auto is_there = [&](const auto& other) {
        return std::hypot(other.x_px - match.x_px, other.y_px - match.y_px) < same_px;
      };
      if (match.likeness >= clear && std::none_of(seen.begin(), seen.end(), is_there) &&
          std::none_of(others.begin(), others.end(), [&](std::size_t k) { return is_there(result.places[k]); }))
        seen.push_back(match);
    }
    return seen.size();
  };
  const double reach_px = std::max(1.0, known.options.search_px), most_px = 0.5 * known.mouth_px;
  double best_step = 0;
  std::size_t best = seen_at(0, reach_px);
  for (double far_px = reach_px; far_px <= most_px && best < marks.size(); far_px += reach_px)
    for (const double sign : {1.0, -1.0}) {
      const double step = sign * far_px / farthest;
      const std::size_t seen = seen_at(step, reach_px);
      if (seen > best) best = seen, best_step = step;
    }
  if (best_step == 0) return result;
  // A lip falls farther than the chin does: each where it is seen better, with the fall or without it.
  for (const std::size_t i : marks) {
    const PatchMatch there = look_for(i, best_step, reach_px), here = look_for(i, 0, reach_px);
    const PatchMatch& match = there.likeness >= here.likeness ? there : here;
    result.found[i] = match.converged && match.likeness >= clear;
    Sighting& place = result.places[i];
    if (result.found[i]) {
      place.x_px = match.x_px, place.y_px = match.y_px;
    } else if (&match == &there) {
      place.x_px += best_step * fall[2 * i], place.y_px += best_step * fall[2 * i + 1];
    }
  }
  // The corners of a mouth that opens come nearer to each other; the rest hardly moves.
  const std::vector<Sighting> before = result.places;
  for (const std::size_t i : others) {
    const PatchMatch match = look_for(i, 0, reach_px);
    bool is_other = false;
    for (std::size_t k = 0; k < before.size(); ++k)
      is_other = is_other || (k != i && known.is_dot(k) &&
                              std::hypot(before[k].x_px - match.x_px, before[k].y_px - match.y_px) < same_px);
    result.found[i] = match.converged && match.likeness >= clear && !is_other;
    if (result.found[i]) result.places[i].x_px = match.x_px, result.places[i].y_px = match.y_px;
  }
  if (std::count(result.found.begin(), result.found.end(), true) < static_cast<std::ptrdiff_t>(fewest))
    result.found.assign(result.found.size(), false);
  return result;
}

}  // namespace face::track
