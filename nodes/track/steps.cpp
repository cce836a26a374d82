// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/steps.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "nodes/base/find_landmark.h"
#include "nodes/track/find_face.h"
#include "nodes/track/jaw_line.h"
#include "nodes/track/mouth_shape.h"
#include "nodes/track/outline.h"
#include "nodes/track/solid_head.h"

namespace face::track {
namespace {

std::size_t patch_offset(const Image& patches, std::size_t index, int row, int side_px, int y) {
  return static_cast<std::size_t>((row * side_px + y) * patches.width + static_cast<int>(index) * side_px);
}

// Adds one sighting to another: both are true within their errors.
void add(const Sighting& more, Sighting& place) {
  const double xx = place.xx + more.xx, xy = place.xy + more.xy, yy = place.yy + more.yy, det = xx * yy - xy * xy;
  if (det <= 1e-12) {
    if (!is_seen(place)) place = more;
    return;
  }
  const double bx = place.xx * place.x_px + place.xy * place.y_px + more.xx * more.x_px + more.xy * more.y_px;
  const double by = place.xy * place.x_px + place.yy * place.y_px + more.xy * more.x_px + more.yy * more.y_px;
  place = {(yy * bx - xy * by) / det, (xx * by - xy * bx) / det, xx, xy, yy};
}

// A sighting may claim no smaller error than this.
void limit(double error_px, Sighting& place) {
  const double largest = (place.xx + place.yy) / 2 + std::hypot((place.xx - place.yy) / 2, place.xy);
  const double scale = largest > 0 ? std::min(1.0, 1 / (error_px * error_px * largest)) : 0;
  place.xx *= scale, place.xy *= scale, place.yy *= scale;
}

Landmarks places_of(Landmarks points, const std::vector<Sighting>& places) {
  for (std::size_t i = 0; i < places.size(); ++i)
    points.points[i].x_px = places[i].x_px, points.points[i].y_px = places[i].y_px;
  return points;
}

// Likeness from which on a point's own patch is seen again. A dot painted on the face is told from skin also where it
// is stretched, seen from the side or in a shade.
double seen_again_from(bool is_dot, const TrackKltOptions& options) {
  constexpr double of_dots = 0.5;
  return is_dot ? std::min(of_dots, options.min_likeness) : options.min_likeness;
}

// How far a point goes to its own patch, 0 to 1.
double anchor_share(double likeness, bool is_dot, const TrackKltOptions& options) {
  const double least = seen_again_from(is_dot, options);
  return std::clamp((likeness - least) / (1 - least) * 2, 0.0, 1.0);
}

bool pull_to_patch(const PatchMatch& match, bool is_dot, const TrackKltOptions& options, Sighting& place) {
  const double most_px = is_dot ? 2 * options.max_anchor_px : options.max_anchor_px;
  if (!match.converged || std::hypot(match.x_px - place.x_px, match.y_px - place.y_px) > most_px) return false;
  const double share = anchor_share(match.likeness, is_dot, options);
  place.x_px += share * (match.x_px - place.x_px);
  place.y_px += share * (match.y_px - place.y_px);
  return true;
}

// Of points that all are of the 18-point layout; else none.
std::vector<double> usual_depths_px(const Landmarks& start) {
  const auto place = [&](const char* name) {
    const Landmark* point = find_landmark(start, name);
    return point ? std::complex<double>(point->x_px, point->y_px) : std::complex<double>(NAN, NAN);
  };
  const double eyes_px = std::abs(place("eye_inner_r") - place("eye_inner_l"));
  if (!std::isfinite(eyes_px)) return {};
  std::vector<double> depths_px;
  for (const Landmark& point : start.points) {
    const double depth = usual_depth(point.name);
    if (depth < 0) return {};
    depths_px.push_back(depth * eyes_px);
  }
  return depths_px;
}

// Where points are expected by all sightings together. No point of the lips is so sure of its place that the others
// could not tell that it has taken its neighbour's: dots painted on them are alike.
std::vector<Sighting> expect(const Knowledge& known, std::vector<Sighting> sightings) {
  constexpr double most_sure_px = 2;
  for (const std::size_t i : known.outline) limit(most_sure_px, sightings[i]);
  return settle(known.start, sightings, known.bonds);
}

}  // namespace

Image empty_patches(std::size_t count, int side_px) {
  Image patches{side_px * static_cast<int>(count), 2 * side_px, 1, {}};
  patches.pixels.assign(static_cast<std::size_t>(patches.width) * static_cast<std::size_t>(patches.height), 0);
  return patches;
}

std::vector<float> patch_of(const Image& patches, std::size_t index, int row, int side_px) {
  std::vector<float> patch;
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      patch.push_back(patches.pixels[patch_offset(patches, index, row, side_px, y) + static_cast<std::size_t>(x)]);
  return patch;
}

int side_of(const Image& patches, std::size_t index, int row, int side_px) {
  constexpr int least_px = 9;
  return telling_side_px(patch_of(patches, index, row, side_px), side_px, least_px);
}

void keep_patch(const Grey& grey, double x_px, double y_px, std::size_t index, int row, int side_px, Image& patches) {
  const std::vector<float> patch = cut_patch(grey, x_px, y_px, side_px);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x)
      patches.pixels[patch_offset(patches, index, row, side_px, y) + static_cast<std::size_t>(x)] =
          static_cast<std::uint8_t>(std::lround(patch[static_cast<std::size_t>(y * side_px + x)]));
}

std::vector<float> own_patch(const Knowledge& known, const Image& patches, std::size_t index) {
  return middle_of(patch_of(patches, index, 0, known.side_px), known.side_px, known.sides_px[index]);
}

Knowledge::Knowledge(const Landmarks& start_points, const TrackKltOptions& given)
    : start(start_points),
      options(given),
      side_px(static_cast<int>(given.window_px)),
      sides_px(start_points.points.size(), side_px),
      outline(find_outline(start_points, given.outline)) {
  bonds.stiffness = options.stiffness;
  if (!outline.empty()) {
    jaw_line = find_jaw_line(start, options.jaw_line);
    mouth_px = mouth_width_px(start, outline);
  }
  bonds.modes = mouth_modes(start, outline, jaw_line);
  for (std::size_t i = 0; i < start.points.size(); ++i)
    if (std::find(options.rigid.begin(), options.rigid.end(), start.points[i].name) != options.rigid.end())
      bonds.rigid.push_back(i);
  bonds.depths_px = usual_depths_px(start);
}

void Knowledge::learn_sides(const Image& patches) {
  for (std::size_t i = 0; i < sides_px.size(); ++i) sides_px[i] = side_of(patches, i, 0, side_px);
}

bool Knowledge::is_dot(std::size_t point) const {
  const auto marks = std::count_if(outline.begin(), outline.end(), [&](std::size_t i) { return is_mark(i); });
  return is_mark(point) && 2 * marks >= static_cast<std::ptrdiff_t>(outline.size());
}

Seen follow(const Knowledge& known, const FlowPair& flow, const Grey& before, const std::vector<Landmark>& points,
            const Leap& leapt) {
  const std::vector<Sighting>& guesses = leapt.places;
  std::vector<Sighting> from;
  for (const Landmark& point : points) {
    from.push_back({point.x_px, point.y_px});
    if (point.valid) add_information(before, known.sides_px[from.size() - 1], from.back());
  }
  Seen seen;
  seen.likeness.assign(points.size(), 0);
  std::vector<Sighting>& to = seen.sightings;
  to = flow.forth(from, guesses, known.sides_px);
  // A dot that is seen where it was looked for is there.
  for (std::size_t k = 0; k < to.size(); ++k)
    if (leapt.found[k]) to[k] = {guesses[k].x_px, guesses[k].y_px, from[k].xx, from[k].xy, from[k].yy};
  // Points that went elsewhere than their neighbours get another try from where these say that they are.
  constexpr int tries = 3;
  for (int i = 0; i < tries; ++i) {
    const std::vector<Sighting> guess = expect(known, to);
    std::vector<Sighting> again_from, again_guess;
    std::vector<std::size_t> again;
    std::vector<int> again_sides_px;
    for (std::size_t k = 0; k < to.size(); ++k) {
      const double off = std::hypot(to[k].x_px - guess[k].x_px, to[k].y_px - guess[k].y_px);
      if (!is_seen(from[k]) || (is_seen(to[k]) && (off <= 1 || leapt.found[k]))) continue;
      again.push_back(k);
      again_from.push_back(from[k]);
      again_guess.push_back(guess[k]);
      again_sides_px.push_back(known.sides_px[k]);
    }
    if (again.empty()) break;
    const std::vector<Sighting> found = flow.forth(again_from, again_guess, again_sides_px);
    for (std::size_t k = 0; k < again.size(); ++k) to[again[k]] = found[k];
  }
  std::vector<Sighting> back_guesses = to;
  for (std::size_t k = 0; k < to.size(); ++k) {
    back_guesses[k].x_px -= guesses[k].x_px - from[k].x_px;
    back_guesses[k].y_px -= guesses[k].y_px - from[k].y_px;
  }
  const std::vector<Sighting> home = flow.back(to, back_guesses, known.sides_px), settled = expect(known, to);
  for (std::size_t k = 0; k < to.size(); ++k) {
    if (!is_seen(to[k])) continue;
    const double dx = home[k].x_px - from[k].x_px, dy = home[k].y_px - from[k].y_px;
    const double return_error = sure_length_px(from[k], dx, dy);
    const double off = sure_length_px(from[k], to[k].x_px - settled[k].x_px, to[k].y_px - settled[k].y_px);
    const bool kept = leapt.found[k] || (is_seen(home[k]) && return_error <= known.options.max_return_error_px &&
                                         off <= known.options.max_offset_px);
    if (!kept)
      forget(to[k]);
    else if (!leapt.found[k])
      seen.return_error_px = std::max(seen.return_error_px, return_error);
  }
  return seen;
}

namespace {

// Puts a dot's point that is beside it, farther than a patch is aligned over, back onto it: to where the dot is seen
// again and no other point is, about its place or about where the others say that it is.
void return_to_dot(const Knowledge& known, const Grey& now, const Image& patches, std::size_t index, Seen& seen) {
  constexpr double taken_px = 3;
  Sighting& place = seen.sightings[index];
  std::vector<Sighting> others = seen.sightings;
  forget(others[index]);
  const auto is_taken = [&](const PatchMatch& match) {
    return std::any_of(others.begin(), others.end(), [&](const Sighting& other) {
      return is_seen(other) && std::hypot(other.x_px - match.x_px, other.y_px - match.y_px) < taken_px;
    });
  };
  const auto look_about = [&](const Sighting& where, double reach_px) {
    const PatchMatch match =
        search_patch(own_patch(known, patches, index), known.sides_px[index], now, where.x_px, where.y_px, reach_px);
    if (!match.converged || match.likeness < known.options.min_likeness ||
        !is_inside(match.x_px, match.y_px, now.width, now.height) || is_taken(match))
      return false;
    place.x_px = match.x_px;
    place.y_px = match.y_px;
    seen.likeness[index] = match.likeness;
    return true;
  };
  if (!look_about(place, 1.5 * known.options.search_px))
    look_about(settle(known.start, others, known.bonds)[index], known.options.search_px);
}

}  // namespace

void anchor(const Knowledge& known, const Grey& now, const Image& patches, Seen& seen) {
  for (std::size_t i = 0; i < seen.sightings.size(); ++i) {
    Sighting& place = seen.sightings[i];
    if (!is_seen(place)) continue;
    const PatchMatch match = align_patch(own_patch(known, patches, i), known.sides_px[i], now, place.x_px, place.y_px);
    const bool near = pull_to_patch(match, known.is_dot(i), known.options, place);
    const auto& rigid = known.bonds.rigid;
    if (near) seen.likeness[i] = std::max(0.0, match.likeness);
    if (known.is_dot(i) && seen.likeness[i] < seen_again_from(true, known.options))
      return_to_dot(known, now, patches, i, seen);
    if (std::find(rigid.begin(), rigid.end(), i) != rigid.end() &&
        !(near && match.likeness >= known.options.min_likeness)) {
      forget(place);
      seen.likeness[i] = 0;
    }
  }
}

void recover(const Knowledge& known, const Grey& now, const Image& patches, double search_px, Seen& seen) {
  const std::vector<Sighting> expected = settle(known.start, seen.sightings, known.bonds);
  for (std::size_t i = 0; i < seen.sightings.size(); ++i) {
    Sighting& place = seen.sightings[i];
    if (is_seen(place)) continue;
    const PatchMatch match = search_patch(own_patch(known, patches, i), known.sides_px[i], now, expected[i].x_px,
                                          expected[i].y_px, search_px);
    const bool found = match.converged && match.likeness >= known.options.min_likeness &&
                       is_inside(match.x_px, match.y_px, now.width, now.height) &&
                       std::hypot(match.x_px - expected[i].x_px, match.y_px - expected[i].y_px) <= search_px;
    if (!found) continue;
    place = {match.x_px, match.y_px};
    add_information(now, known.sides_px[i], place);
    seen.likeness[i] = match.likeness;
  }
}

Seen find_again(const Knowledge& known, const Grey& now, const Image& face, const Image& patches) {
  constexpr double enough = 0.5, step_px = 4;  // correlation of the small picture; error of its place
  Seen seen;
  for (const Landmark& point : known.start.points) seen.sightings.push_back({point.x_px, point.y_px});
  seen.likeness.assign(seen.sightings.size(), 0);
  const FaceMatch match = find_face(now, known.start, face);
  if (match.likeness < enough) return seen;
  for (std::size_t i = 0; i < seen.sightings.size(); ++i) {
    const Landmark& point = known.start.points[i];
    seen.sightings[i] = {point.x_px + match.dx_px, point.y_px + match.dy_px};
    // A first guess that any real sighting overrules.
    seen.sightings[i].xx = seen.sightings[i].yy = 1e-3;
  }
  Seen found = seen;
  for (Sighting& place : found.sightings) forget(place);
  for (std::size_t i = 0; i < found.sightings.size(); ++i) {
    const Sighting& guess = seen.sightings[i];
    const PatchMatch patch = search_patch(own_patch(known, patches, i), known.sides_px[i], now, guess.x_px, guess.y_px,
                                          known.options.search_px + step_px);
    if (!patch.converged || patch.likeness < known.options.min_likeness ||
        !is_inside(patch.x_px, patch.y_px, now.width, now.height))
      continue;
    found.sightings[i] = {patch.x_px, patch.y_px};
    add_information(now, known.sides_px[i], found.sightings[i]);
    found.likeness[i] = patch.likeness;
  }
  const auto seen_of = [&](const std::vector<std::size_t>& points) {
    return std::count_if(points.begin(), points.end(), [&](std::size_t i) { return is_seen(found.sightings[i]); });
  };
  const auto all = std::count_if(found.sightings.begin(), found.sightings.end(), is_seen);
  const bool there = known.bonds.rigid.size() >= 2 ? seen_of(known.bonds.rigid) >= 2
                                                   : 3 * all >= static_cast<std::ptrdiff_t>(found.sightings.size());
  if (!there)
    for (std::size_t i = 0; i < found.sightings.size(); ++i) forget(found.sightings[i]), found.likeness[i] = 0;
  return found;
}

void fit_contours(const Knowledge& known, const Image& frame, const Grey& now, const Matrix& look,
                  const Matrix& jaw_look, Seen& seen) {
  // What KLT may claim on lips, which change their looks, and on even skin, along which it drifts; and a patch that
  // looks as at the start, one that tells its place in every direction.
  constexpr double follow_error_px = 1, skin_error_px = 2, patch_error_px = 0.2, mark_error_px = 0.1;
  constexpr double least_likeness = 0.3;
  std::vector<Sighting> followed = seen.sightings, unseen = seen.sightings;
  for (const std::size_t i : known.outline) {
    const double error_px = known.is_mark(i) ? mark_error_px : patch_error_px;
    const double share = anchor_share(seen.likeness[i], known.is_dot(i), known.options);
    limit(1 / std::sqrt(1 / (follow_error_px * follow_error_px) + share / (error_px * error_px)), followed[i]);
    forget(unseen[i]);
  }
  for (const std::size_t i : known.jaw_line)
    if (!known.is_mark(i)) limit(skin_error_px, followed[i]);
  std::vector<Sighting> settled = settle(known.start, followed, known.bonds);
  if (!known.outline.empty() && std::any_of(seen.sightings.begin(), seen.sightings.end(), is_seen)) {
    const Landmarks rest = places_of(known.start, settle(known.start, unseen, known.bonds));
    constexpr int rounds = 2;  // the normals of the first are of the expected shape
    for (int round = 0; round < rounds; ++round) {
      const Landmarks expected = places_of(known.start, settled);
      std::vector<Sighting> both = followed;
      const auto take = [&](const EdgeSight& edge, const std::vector<std::size_t>& points) {
        for (std::size_t k = 0; k < points.size(); ++k) {
          const std::size_t i = points[k];
          // A dot that is seen knows better.
          if (known.is_mark(i) && is_seen(seen.sightings[i]) &&
              anchor_share(seen.likeness[i], known.is_dot(i), known.options) >= 1)
            continue;
          add(edge.sightings[k], both[i]);
          if (round + 1 < rounds) continue;
          if (edge.likeness[k] < least_likeness && !is_seen(seen.sightings[i])) forget(both[i]);
          seen.likeness[i] = is_seen(both[i]) ? std::max(seen.likeness[i], edge.likeness[k]) : 0;
        }
      };
      take(see_outline(frame, expected, rest, known.outline, look, known.options.edge_reach_px), known.outline);
      if (!known.jaw_line.empty())
        take(see_jaw_line(now, expected, known.jaw_line, known.outline, known.mouth_px, jaw_look), known.jaw_line);
      settled = settle(known.start, both, known.bonds);
    }
  }
  seen.sightings = std::move(settled);
}

bool follow_corrected(const Knowledge& known, const FlowPair& flow, const Grey& before, const Grey& now,
                      const Landmarks& layout, const Landmarks& others, const Image& patches, std::size_t index,
                      Landmark& point) {
  constexpr double other_error_px = 0.1, follow_error_px = 1;
  std::vector<Sighting> places;
  for (const Landmark& other : others.points) {
    places.push_back({other.x_px, other.y_px});
    if (other.valid) places.back().xx = places.back().yy = 1 / (other_error_px * other_error_px);
  }
  forget(places[index]);
  const Sighting expected = settle(layout, places, known.bonds)[index];
  const int side_px = side_of(patches, index, 1, known.side_px);
  Sighting from{point.x_px, point.y_px}, guess = expected;
  add_information(before, side_px, from);
  Sighting to = point.valid ? flow.forth({from}, {guess}, {side_px})[0] : Sighting{};
  if (is_seen(to)) {
    const Sighting home = flow.back({to}, {from}, {side_px})[0];
    const bool kept = is_seen(home) && sure_length_px(from, home.x_px - from.x_px, home.y_px - from.y_px) <=
                                           known.options.max_return_error_px;
    if (!kept) forget(to);
  }
  const std::vector<float> patch = middle_of(patch_of(patches, index, 1, known.side_px), known.side_px, side_px);
  if (is_seen(to)) {
    pull_to_patch(align_patch(patch, side_px, now, to.x_px, to.y_px), known.is_dot(index) && side_px < known.side_px,
                  known.options, to);
  } else {
    const PatchMatch match = search_patch(patch, side_px, now, expected.x_px, expected.y_px, known.options.search_px);
    if (match.converged && match.likeness >= known.options.min_likeness) {
      to = {match.x_px, match.y_px};
      add_information(now, side_px, to);
    }
  }
  const bool on_lips = std::find(known.outline.begin(), known.outline.end(), index) != known.outline.end();
  if (on_lips) limit(follow_error_px, to);
  places[index] = to;
  const Sighting settled = settle(layout, places, known.bonds)[index];
  // On lips the neighbours, which keep to the edge, are enough.
  point.valid = (is_seen(to) || (on_lips && others.points[index].valid)) &&
                is_inside(settled.x_px, settled.y_px, now.width, now.height);
  if (point.valid) point.x_px = settled.x_px, point.y_px = settled.y_px;
  return point.valid;
}

}  // namespace face::track
