// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/track_klt.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "nodes/base/check_image.h"
#include "nodes/base/find_landmark.h"
#include "nodes/track/find_face.h"
#include "nodes/track/head_motion.h"
#include "nodes/track/jaw_line.h"
#include "nodes/track/light_change.h"
#include "nodes/track/mouth_shape.h"
#include "nodes/track/outline.h"
#include "nodes/track/shrink.h"
#include "nodes/track/smooth_noise.h"
#include "nodes/track/steps.h"

namespace face::track {
namespace {

void check_inputs(const engine::Window<Image>& frames, const Landmarks& start, const Landmarks* correction,
                  const engine::Prior<TrackKltResult>& prior, const TrackKltOptions& options) {
  const Image& frame = frames.centre();
  for (std::size_t i = 0; i < frames.size(); ++i) check_image(frames[i], "a frame");
  check(options.window_px % 2 == 1, "window_px is ", options.window_px, ", expected an odd number");
  for (const Landmark& point : start.points)
    if (!is_inside(point.x_px, point.y_px, frame.width, frame.height))
      fail("start point ", point.name, " is at (", point.x_px, ", ", point.y_px, "), outside the frame of ",
           frame.width, " x ", frame.height, " pixels");
  for (std::size_t i = 0; correction && i < correction->points.size(); ++i) {
    const Landmark& fixed = correction->points[i];
    check(landmark_index(start, fixed.name) < start.points.size(), "a correction names the point ", fixed.name,
          ", which start does not have; it has ", landmark_names(start));
    if (!is_inside(fixed.x_px, fixed.y_px, frame.width, frame.height))
      fail("the correction of ", fixed.name, " is at (", fixed.x_px, ", ", fixed.y_px, "), outside the frame of ",
           frame.width, " x ", frame.height, " pixels");
  }
  if (!prior) return;
  check(frames.centre_index() > 0, "frames has no previous frame although there is a previous result");
  const Image& previous = frames[frames.centre_index() - 1];
  check(previous.width == frame.width && previous.height == frame.height, "the frame is ", frame.width, " x ",
        frame.height, " pixels, the previous one ", previous.width, " x ", previous.height);
  check(prior->landmarks.points.size() == start.points.size(), "the previous result has ",
        prior->landmarks.points.size(), " points, start has ", start.points.size());
}

TrackKltResult begin(const Knowledge& known, const Image& frame, const Grey& now) {
  TrackKltResult result;
  result.followed = result.layout = known.start;
  result.patches = empty_patches(known.start.points.size(), known.side_px);
  for (std::size_t i = 0; i < known.start.points.size(); ++i)
    keep_patch(now, known.start.points[i].x_px, known.start.points[i].y_px, i, 0, known.side_px, result.patches);
  if (!known.outline.empty()) {
    result.look = learn_outline(frame, known.start, known.outline);
    const Shrink coarse = coarse_shrink(known, frame);
    if (!coarse.is_none())
      result.coarse_look = learn_outline(coarse.image(frame), coarse.to_small(known.start), known.outline);
  }
  if (!known.jaw_line.empty())
    result.jaw_look = learn_jaw_line(now, known.start, known.jaw_line, known.outline, known.mouth_px);
  result.face = learn_face(now, known.start);
  if (!known.bonds.depths_px.empty()) result.head_look = learn_head(now, known.start);
  if (!result.head_look.pixels.empty()) {
    result.head = head_numbers({start_pose(known.start), 1});
    result.face_colours = learn_light(frame, known.start);
    result.light = light_numbers({});
  }
  result.confidence = {known.start.points.size(), 1, std::vector<double>(known.start.points.size(), 1.0)};
  result.state = "start";
  return result;
}

// Of a film that begins with nothing to see.
TrackKltResult not_begun(const Landmarks& start) {
  TrackKltResult result;
  result.followed = start;
  for (Landmark& point : result.followed.points) point.valid = false;
  result.layout = start;
  result.confidence = {start.points.size(), 1, std::vector<double>(start.points.size(), 0.0)};
  result.state = "even";
  result.valid = false;
  return result;
}

// Whether this frame is the first one to track: the film was black until now, or it becomes visible, and what was
// learnt in the dark is worth little.
bool begins_here(const engine::Window<Image>& frames, const TrackKltResult& previous) {
  if (!previous.put_right.points.empty()) return false;
  if (previous.state == "even" && previous.patches.pixels.empty()) return true;
  constexpr double growing = 1.05;  // a fade of a second and less
  if (previous.state != "start") return false;
  const Grey before = grey_of(frames[frames.centre_index() - 1]), now = grey_of(frames.centre());
  return spread_of(now) > growing * spread_of(before) && !is_cut(before, now);
}

// Where rigid points that are not seen are now: a head hardly turns from one frame to the next, so they go with those
// that are seen. Without them one point would have to tell how the head is turned.
std::vector<Sighting> carry_unseen(const Knowledge& known, const std::vector<Landmark>& before, const Seen& seen) {
  double dx_px = 0, dy_px = 0, count = 0;
  for (const std::size_t i : known.bonds.rigid) {
    if (!is_seen(seen.sightings[i])) continue;
    dx_px += seen.sightings[i].x_px - before[i].x_px;
    dy_px += seen.sightings[i].y_px - before[i].y_px;
    ++count;
  }
  if (count == 0) return {};
  constexpr double error_px = 2;
  std::vector<Sighting> carried(before.size());
  for (const std::size_t i : known.bonds.rigid) {
    carried[i] = sighted(before[i].x_px + dx_px / count, before[i].y_px + dy_px / count, error_px);
  }
  return carried;
}

Seen seen_before(const std::vector<Landmark>& points) {
  Seen seen;
  for (const Landmark& point : points) {
    const double sure = point.valid ? 1 : 0;
    seen.sightings.push_back({point.x_px, point.y_px, sure, 0, sure});
  }
  return seen;
}

// Finds the head near where it was. Returns where the points are when they go along with it.
std::vector<Sighting> follow_head(Knowledge& known, const Grey& now, std::vector<Sighting> places,
                                  TrackKltResult& result) {
  if (result.head_look.pixels.empty()) return places;
  const HeadPose before = head_sight(result.head).pose;
  const HeadSight sight = find_head(now, known.start, result.head_look, before);
  if (sight.likeness < head_is_seen) return places;
  result.head = head_numbers(sight);
  known.bonds.head = head_at(sight.pose, known.start);
  return go_along(known, head_at(before, known.start), *known.bonds.head, std::move(places));
}

// Whether what is followed is another face than in the frame before: from one frame to the next a head stays all but
// the same, however it moves (0.98 and more in six real clips; 0.75 and less over a cut from one speaker to another),
// and where a hand hides much of it, other points are as they were (0.97 and more for a quarter of them; 0.96 and less
// over a cut). Faces that sit alike are followed from one to the other without a point being lost.
bool is_another_face(const Knowledge& known, const Grey& before, const Grey& now, const Landmarks& points,
                     const Seen& seen, double head_likeness_drop) {
  constexpr double sudden = 0.15, same_head = 0.76, same_point = 0.97;
  if (head_likeness_drop < sudden) return false;
  const Image look = learn_head(before, points);
  if (look.pixels.empty() || find_head(now, points, look, start_pose(points)).likeness >= same_head) return false;
  std::size_t same = 0;
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const Landmark& point = points.points[i];
    const std::vector<float> patch = cut_patch(before, point.x_px, point.y_px, known.side_px);
    const Sighting& place = seen.sightings[i];
    same += align_patch(patch, known.side_px, now, place.x_px, place.y_px).likeness >= same_point ? 1 : 0;
  }
  return 4 * same < points.points.size();
}

// Of a face that was found again as large and as upright as at the start. Who looks otherwise is somebody else: other
// speakers' heads are up to 0.80 like the first one, a speaker's own 0.94 and more while it looks to the camera.
void find_head_again(Knowledge& known, const Grey& now, Seen& seen, TrackKltResult& result) {
  constexpr double same_head = 0.85;
  if (result.head_look.pixels.empty()) return;
  double dx_px = 0, dy_px = 0, count = 0;
  for (std::size_t i = 0; i < seen.sightings.size(); ++i) {
    if (!is_seen(seen.sightings[i])) continue;
    dx_px += seen.sightings[i].x_px - known.start.points[i].x_px;
    dy_px += seen.sightings[i].y_px - known.start.points[i].y_px;
    ++count;
  }
  if (count == 0) return;
  HeadPose pose = start_pose(known.start);
  pose.x_px += dx_px / count, pose.y_px += dy_px / count;
  result.head = head_numbers({pose, 0});
  follow_head(known, now, seen.sightings, result);
  if (result.head.values.back() >= same_head) return;
  known.bonds.head.reset();
  result.head.values.back() = 0;
  for (Sighting& place : seen.sightings) forget(place);
}

// The points as they are without corrections.
void advance(Knowledge& known, const FlowPair& flow, const Image& frame, const Grey& before, const Grey& now,
             TrackKltResult& result) {
  auto& points = result.followed.points;
  const bool was_valid = result.valid, even = is_even(now);
  const double likeness_before = result.head.values.empty() ? 0 : result.head.values.back();
  if (!result.head.values.empty()) result.head.values.back() = 0;  // until it is seen
  bool cut = false;
  Seen seen;
  seen.likeness.assign(points.size(), 0);
  for (const Landmark& point : points) seen.sightings.push_back({point.x_px, point.y_px});
  if (was_valid && !even) {
    const std::vector<Sighting> places = follow_head(known, now, seen.sightings, result);
    known.bonds.carried = carry_unseen(known, points, seen_before(points));
    seen = follow(known, flow, before, points, leap(known, now, result.patches, places));
    if (known.bonds.head) seen.head_likeness = result.head.values.back();
    anchor(known, now, result.patches, seen);
    // A face that moves fast over a patterned ground looks like a cut, but is followed.
    const auto kept = std::count_if(seen.sightings.begin(), seen.sightings.end(), is_seen);
    cut = (2 * kept < static_cast<std::ptrdiff_t>(points.size()) && is_cut(before, now)) ||
          (!result.head.values.empty() &&
           is_another_face(known, before, now, result.followed, seen, likeness_before - result.head.values.back()));
    if (!cut) known.bonds.carried = carry_unseen(known, points, seen);
    if (!cut) recover(known, now, result.patches, known.options.search_px, seen);
  }
  if ((!was_valid || cut) && !even) {
    known.bonds.head.reset();
    seen = find_again(known, now, result.face, result.patches);
    find_head_again(known, now, seen, result);
  }
  constexpr double well_seen = 0.7;  // likeness of a head that nothing hides: a hand before it is no lamp
  if (known.bonds.head && result.head.values.back() >= well_seen)
    result.light = light_numbers(see_light_change(frame, known.start, *known.bonds.head, result.face_colours));
  Image room;
  const Image& lit = in_start_light(frame, light_of(result.light), room);
  const Shrink coarse = coarse_shrink(known, frame);
  const Image small = result.coarse_look.rows > 0 ? coarse.image(lit) : Image{};
  std::vector<LipPicture> lips;
  if (result.coarse_look.rows > 0) lips.push_back({small, coarse, result.coarse_look});
  lips.push_back({lit, Shrink(frame.width, frame.height, 1), result.look});
  fit_contours(known, lips, now, result.jaw_look, seen);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Sighting& place = seen.sightings[i];
    points[i].valid = is_seen(place) && is_inside(place.x_px, place.y_px, now.width, now.height);
    valid += points[i].valid ? 1 : 0;
    result.confidence.at(i, 0) = points[i].valid ? seen.likeness[i] : 0;
  }
  result.valid = points.empty() || ((3 * valid >= points.size() || known.bonds.head) && !even);
  result.return_error_px = seen.return_error_px;
  result.state = even ? "even" : cut ? "cut" : !result.valid ? "lost" : was_valid ? "followed" : "found";
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!result.valid) points[i].valid = false, result.confidence.at(i, 0) = 0;
    const Sighting& place = seen.sightings[i];
    const bool goes_along = result.valid && is_inside(place.x_px, place.y_px, now.width, now.height);
    if (goes_along) points[i].x_px = place.x_px, points[i].y_px = place.y_px;
  }
}

// Puts points where somebody says that they are. The layout learns by how much that differs from where the neighbours
// would have put the point, so that the springs do not pull it back afterwards. What a point was before its correction
// leaves no trace, so that a change of an earlier correction ends here.
void put_right(const Knowledge& known, const Landmarks& correction, const Grey& now, TrackKltResult& result) {
  const auto& points = result.followed.points;
  for (const Landmark& fixed : correction.points) {
    const std::size_t index = landmark_index(result.followed, fixed.name);
    std::vector<Sighting> others;
    for (const Landmark& p : points) others.push_back(p.valid ? Sighting{p.x_px, p.y_px, 1, 0, 1} : Sighting{});
    forget(others[index]);
    const Sighting expected = settle(known.start, others, known.bonds)[index];
    Landmark& at_rest = result.layout.points[index];
    at_rest = known.start.points[index];
    at_rest.x_px += fixed.x_px - expected.x_px;
    at_rest.y_px += fixed.y_px - expected.y_px;
    keep_patch(now, fixed.x_px, fixed.y_px, index, 1, known.side_px, result.patches);
    auto& corrected = result.put_right.points;
    const std::size_t before = landmark_index(result.put_right, fixed.name);
    if (before == corrected.size()) corrected.emplace_back();
    corrected[before] = {fixed.name, fixed.x_px, fixed.y_px, true};
    result.valid = true;
  }
  std::sort(result.put_right.points.begin(), result.put_right.points.end(),
            [](const Landmark& a, const Landmark& b) { return a.name < b.name; });
}

TrackKltResult track(const engine::Window<Image>& frames, const Landmarks& start, const Landmarks* correction,
                     const engine::Prior<TrackKltResult>& prior, const TrackKltOptions& options) {
  Image room, room_before;
  const Image& frame = without_noise(frames.centre(), start, room);
  const Grey now = grey_of(frame);
  Knowledge known(start, options);
  TrackKltResult result;
  if (prior) {
    result = *prior;
    known.learn_sides(result.patches);
    const Grey before = grey_of(without_noise(frames[frames.centre_index() - 1], start, room_before));
    const FlowPair flow(before, now, known.side_px, static_cast<int>(options.levels));
    advance(known, flow, frame, before, now, result);
    for (Landmark& point : result.put_right.points) {
      const std::size_t index = landmark_index(start, point.name);
      if (!result.valid)
        point.valid = false;
      else
        follow_corrected(known, flow, before, now, result.layout, result.followed, result.patches, index, point);
    }
  } else {
    result = is_even(now) && !correction && !start.points.empty() ? not_begun(start) : begin(known, frame, now);
  }
  if (correction) put_right(known, *correction, now, result);
  result.landmarks = result.followed;
  for (const Landmark& point : result.put_right.points) {
    const std::size_t index = landmark_index(start, point.name);
    result.landmarks.points[index] = point;
    if (!point.valid) result.confidence.at(index, 0) = 0;
  }
  result.lost = static_cast<double>(std::count_if(result.landmarks.points.begin(), result.landmarks.points.end(),
                                                  [](const Landmark& p) { return !p.valid; }));
  return result;
}

// By what the pictures are made smaller.
double times_to_shrink(const Image& frame, const Landmarks& start, const TrackKltOptions& options) {
  const std::vector<std::size_t> outline = find_outline(start, options.outline);
  if (outline.empty()) return 1;
  const double mouth_px = mouth_width_px(start, outline), times = mouth_px / options.tracked_mouth_px;
  if (mouth_px < options.smallest_mouth_px || mouth_px > options.largest_mouth_px) return times;
  constexpr double worth_it = 1.1, margin = 0.2;  // of the mouth's width
  const Shrink shrink(frame.width, frame.height, std::max(1.0, times));
  const bool is_soft = times > worth_it && lost_contrast(frame, shrink, start, margin * mouth_px) < options.fine_detail;
  return is_soft ? times : 1;
}

// The same in smaller pictures.
TrackKltResult track_small(const engine::Window<Image>& frames, const Landmarks& start, const Landmarks* correction,
                           const engine::Prior<TrackKltResult>& prior, const TrackKltOptions& options,
                           const Shrink& shrink) {
  std::vector<std::shared_ptr<const Image>> images;
  for (std::size_t i = 0; i < frames.size(); ++i)
    images.push_back(std::make_shared<const Image>(shrink.image(frames[i])));
  const engine::Window<Image> small_frames(std::move(images), frames.centre_index());
  const auto each = [](TrackKltResult result, const auto& turn) {
    for (Landmarks* points : {&result.landmarks, &result.followed, &result.put_right, &result.layout})
      *points = turn(std::move(*points));
    if (result.head.rows > 0) {
      const Landmarks place = turn(Landmarks{{{"head", result.head.at(4, 0), result.head.at(5, 0)}}});
      result.head.at(4, 0) = place.points[0].x_px, result.head.at(5, 0) = place.points[0].y_px;
    }
    return result;
  };
  const auto to_small = [&](Landmarks points) { return shrink.to_small(std::move(points)); };
  const auto to_full = [&](Landmarks points) { return shrink.to_full(std::move(points)); };
  engine::Prior<TrackKltResult> small_prior;
  if (prior) {
    auto small = std::make_shared<TrackKltResult>(each(*prior, to_small));
    small->return_error_px /= shrink.times();
    small_prior = engine::Prior<TrackKltResult>(std::move(small));
  }
  Landmarks small_correction;
  if (correction) small_correction = shrink.to_small(*correction);
  TrackKltResult result =
      each(track(small_frames, shrink.to_small(start), correction ? &small_correction : nullptr, small_prior, options),
           to_full);
  result.return_error_px *= shrink.times();
  return result;
}

}  // namespace

TrackKltResult track_klt(const engine::Window<Image>& frames, const Landmarks& start, const Landmarks* correction,
                         const engine::Prior<TrackKltResult>& prior, const TrackKltOptions& options) {
  check_inputs(frames, start, correction, prior, options);
  const Image& frame = frames.centre();
  const engine::Prior<TrackKltResult> last =
      prior && begins_here(frames, *prior) ? engine::Prior<TrackKltResult>{} : prior;
  const double shrunk = last ? last->shrunk : times_to_shrink(frame, start, options);
  const Shrink shrink(frame.width, frame.height, shrunk);
  TrackKltResult result = shrink.is_none() ? track(frames, start, correction, last, options)
                                           : track_small(frames, start, correction, last, options, shrink);
  result.shrunk = shrunk;
  return result;
}

}  // namespace face::track
