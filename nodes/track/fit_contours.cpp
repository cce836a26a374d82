// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "nodes/track/jaw_line.h"
#include "nodes/track/mouth_shape.h"
#include "nodes/track/outline.h"
#include "nodes/track/steps.h"

namespace face::track {
namespace {

double mean_likeness_below(const EdgeSight& edge) {
  const std::size_t half = edge.likeness.size() / 2;
  const auto first = edge.likeness.begin() + static_cast<std::ptrdiff_t>(half) + 1;
  return std::accumulate(first, edge.likeness.end(), 0.0) / static_cast<double>(edge.likeness.end() - first);
}

// A lower lip may go farther from one frame to the next than its edge is looked for. Where it does not look as it
// should, it is taken to where it does, along the fall of the jaw (mouth_shape.h), with the jaw; else false. rest:
// where the head alone would put the points.
bool leap_below(const Knowledge& known, const LipPicture& lips, const std::vector<Sighting>& rest,
                std::vector<Sighting>& places) {
  constexpr double well_seen = 0.5, clearly_better = 0.15, per_deviation = 0.02;
  const auto look_at = [&](const std::vector<Sighting>& there) {
    return mean_likeness_below(lips.see(known, there, rest));
  };
  const double here = look_at(places);
  if (here >= well_seen) return false;
  const std::size_t one = known.outline[0], other = known.outline[known.outline.size() / 2];
  const auto across = [&](const auto& points) {
    return std::complex<double>(points[other].x_px - points[one].x_px, points[other].y_px - points[one].y_px);
  };
  const std::complex<double> turn = across(rest) / across(known.start.points);
  const std::vector<double>& fall = known.bonds.modes[lower_lip_mode];
  double largest_px = 1e-9;
  for (std::size_t i = 0; i < places.size(); ++i)
    largest_px = std::max(largest_px, std::hypot(fall[2 * i], fall[2 * i + 1]));
  const double step = 1.5 * lips.shrink.times() * known.options.edge_reach_px / largest_px,
               most = 0.5 * known.mouth_px / largest_px;
  // Lips that meet are still two lips.
  constexpr double least_height = 0.2;  // of the mouth's width
  const std::size_t half = known.outline.size() / 2, above = known.outline[half / 2],
                    below = known.outline[half + half / 2];
  const auto height = [&](const std::vector<Sighting>& at) {
    const std::complex<double> down(at[below].x_px - at[above].x_px, at[below].y_px - at[above].y_px);
    return (down / across(rest)).imag();
  };
  double best = here + clearly_better;
  bool found = false;
  const std::vector<Sighting> from = places;
  for (double far = step; far <= most; far += step)
    for (const double sign : {-1.0, 1.0}) {
      std::vector<Sighting> there = from;
      for (std::size_t i = 0; i < there.size(); ++i) {
        const std::complex<double> move = sign * far * turn * std::complex<double>(fall[2 * i], fall[2 * i + 1]);
        there[i].x_px += move.real(), there[i].y_px += move.imag();
      }
      if (height(there) < least_height) continue;
      const double quality = look_at(there) - per_deviation * far;
      if (quality > best) best = quality, places = there, found = true;
    }
  return found;
}

}  // namespace

Shrink coarse_shrink(const Knowledge& known, const Image& frame) {
  constexpr double worth_it = 1.2;
  const double times = known.mouth_px / known.options.tracked_mouth_px;
  return {frame.width, frame.height, times >= worth_it ? times : 1};
}

EdgeSight LipPicture::see(const Knowledge& known, const std::vector<Sighting>& expected,
                          const std::vector<Sighting>& rest) const {
  EdgeSight edge =
      see_outline(image, shrink.to_small(places_of(known.start, expected)),
                  shrink.to_small(places_of(known.start, rest)), known.outline, look, known.options.edge_reach_px);
  if (shrink.is_none()) return edge;
  Landmarks places;
  for (const Sighting& place : edge.sightings) places.points.push_back({"", place.x_px, place.y_px});
  places = shrink.to_full(std::move(places));
  const double less = 1 / (shrink.times() * shrink.times());
  for (std::size_t k = 0; k < edge.sightings.size(); ++k) {
    Sighting& place = edge.sightings[k];
    place = {places.points[k].x_px, places.points[k].y_px, less * place.xx, less * place.xy, less * place.yy};
  }
  return edge;
}

void fit_contours(const Knowledge& known, const std::vector<LipPicture>& lips, const Grey& now, const Matrix& jaw_look,
                  Seen& seen) {
  // What KLT may claim on lips, which change their looks, and on even skin, along which it drifts; and a patch that
  // looks as at the start, one that tells its place in every direction.
  constexpr double follow_error_px = 1, skin_error_px = 2, patch_error_px = 0.2, mark_error_px = 0.1;
  constexpr double least_likeness = 0.3;
  std::vector<Sighting> followed = seen.sightings, unseen = seen.sightings;
  for (const std::size_t i : known.outline) {
    const double error_px = known.is_mark(i) ? mark_error_px : patch_error_px;
    const double share = anchor_share(known.options, known.is_dot(i), seen.likeness[i]);
    limit(1 / std::sqrt(1 / (follow_error_px * follow_error_px) + share / (error_px * error_px)), followed[i]);
    forget(unseen[i]);
  }
  for (const std::size_t i : known.jaw_line)
    if (!known.is_mark(i)) limit(skin_error_px, followed[i]);
  std::vector<Sighting> settled = settle(known.start, followed, known.bonds);
  if (!known.outline.empty() && std::any_of(seen.sightings.begin(), seen.sightings.end(), is_seen)) {
    const std::vector<Sighting> rest = settle(known.start, unseen, known.bonds);
    if (leap_below(known, lips.front(), rest, settled)) {
      const std::vector<double>& fall = known.bonds.modes[lower_lip_mode];
      for (std::size_t i = 0; i < followed.size(); ++i)
        if (std::hypot(fall[2 * i], fall[2 * i + 1]) > 0) forget(followed[i]), forget(seen.sightings[i]);
    }
    // In the last picture twice: the normals of the first round are of the expected shape.
    const std::size_t rounds = lips.size() + 1;
    EdgeSight coarse;
    for (std::size_t round = 0; round < rounds; ++round) {
      const Landmarks expected = places_of(known.start, settled);
      std::vector<Sighting> both = followed;
      const auto take = [&](const EdgeSight& edge, const std::vector<std::size_t>& points) {
        for (std::size_t k = 0; k < points.size(); ++k) {
          const std::size_t i = points[k];
          // A dot that is seen knows better.
          if (known.is_mark(i) && is_seen(seen.sightings[i]) &&
              anchor_share(known.options, known.is_dot(i), seen.likeness[i]) >= 1)
            continue;
          add(edge.sightings[k], both[i]);
          if (round + 1 < rounds) continue;
          if (edge.likeness[k] < least_likeness && !is_seen(seen.sightings[i])) forget(both[i]);
          seen.likeness[i] = is_seen(both[i]) ? std::max(seen.likeness[i], edge.likeness[k]) : 0;
        }
      };
      EdgeSight edge = lips[std::min(round, lips.size() - 1)].see(known, settled, rest);
      if (round == 0) coarse = edge;
      if (lips.size() > 1 && round > 0)
        for (std::size_t k = 0; k < edge.sightings.size(); ++k) {
          add(coarse.sightings[k], edge.sightings[k]);
          edge.likeness[k] = std::max(edge.likeness[k], coarse.likeness[k]);
        }
      take(edge, known.outline);
      if (!known.jaw_line.empty())
        take(see_jaw_line(now, expected, known.jaw_line, known.outline, known.mouth_px, jaw_look), known.jaw_line);
      settled = settle(known.start, both, known.bonds);
    }
  }
  seen.sightings = std::move(settled);
}

}  // namespace face::track
