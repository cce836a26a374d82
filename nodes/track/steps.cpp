// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/steps.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "nodes/track/find_face.h"
#include "nodes/track/solid_head.h"

namespace face::track {
namespace {

bool pull_to_patch(const PatchMatch& match, bool is_dot, const TrackKltOptions& options, Sighting& place) {
  const double most_px = is_dot ? 2 * options.max_anchor_px : options.max_anchor_px;
  if (!match.converged || std::hypot(match.x_px - place.x_px, match.y_px - place.y_px) > most_px) return false;
  const double share = anchor_share(options, is_dot, match.likeness);
  place.x_px += share * (match.x_px - place.x_px);
  place.y_px += share * (match.y_px - place.y_px);
  return true;
}

// A rigid point that is farther than that from where the head has it is seen elsewhere: on a cheek, a lid, a strand.
// How deep eyes lie differs from person to person, which counts the more the farther the head is turned.
bool is_on_head(const Knowledge& known, std::size_t point, const Sighting& place) {
  if (!known.bonds.head) return true;
  constexpr double most_px = 2, depth_error = 0.25;  // the second in distances of the corners of the eyes
  const SolidHead& head = *known.bonds.head;
  const double turned_px = depth_error * known.eyes_px * std::hypot(head.turn[2], head.turn[5]);
  return std::abs(known.on_head(head, point) - std::complex<double>(place.x_px, place.y_px)) <= most_px + turned_px;
}

// Where points are expected by all sightings together. No point of the lips is so sure of its place that the others
// could not tell that it has taken its neighbour's: dots painted on them are alike.
std::vector<Sighting> expect(const Knowledge& known, std::vector<Sighting> sightings) {
  constexpr double most_sure_px = 2;
  for (const std::size_t i : known.outline) limit(most_sure_px, sightings[i]);
  return settle(known.start, sightings, known.bonds);
}

}  // namespace

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
    if (known.is_dot(i) && seen.likeness[i] < seen_again_from(known.options, true))
      return_to_dot(known, now, patches, i, seen);
    if (std::find(rigid.begin(), rigid.end(), i) != rigid.end() &&
        !(near && match.likeness >= known.options.min_likeness && is_on_head(known, i, place))) {
      forget(place);
      seen.likeness[i] = 0;
    }
  }
  // What is seen of the head says where its points are, with lids over the corners of the eyes, too.
  if (!known.bonds.head) return;
  constexpr double head_error_px = 0.7;
  for (const std::size_t i : known.bonds.rigid) {
    if (is_seen(seen.sightings[i])) continue;
    const std::complex<double> place = known.on_head(*known.bonds.head, i);
    seen.sightings[i] = sighted(place.real(), place.imag(), head_error_px);
    seen.likeness[i] = seen.head_likeness;
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

bool follow_corrected(const Knowledge& known, const FlowPair& flow, const Grey& before, const Grey& now,
                      const Landmarks& layout, const Landmarks& others, const Image& patches, std::size_t index,
                      Landmark& point) {
  constexpr double other_error_px = 0.1, follow_error_px = 1;
  std::vector<Sighting> places;
  for (const Landmark& other : others.points) {
    places.push_back(other.valid ? sighted(other.x_px, other.y_px, other_error_px) : Sighting{other.x_px, other.y_px});
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
