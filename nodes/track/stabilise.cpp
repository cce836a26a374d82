// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/stabilise.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"
#include "nodes/track/head_motion.h"
#include "nodes/track/solid_head.h"

namespace face::track {
namespace {

using Point = std::complex<double>;

constexpr std::size_t smoothing_reach = 3;  // frames on either side
constexpr std::size_t bridge_reach = 30;    // the same; a slow blink takes 0.8 s, 40 frames of a film of 50 a second

struct Pair {
  Point from, to;
  double weight = 1;
  double depth_px = 0;  // of the point at rest
};

// Rigid points tremble by up to a pixel where the inner corners of the eyes are 30 px apart. What goes beyond that, as
// a share of how far the rigid points are from their middle (20 px there), is motion: of a camera in somebody's hand,
// of a head that starts.
constexpr double trembling = 0.1;

// Of the whole head's pose: on phantoms who turn and nod it is off by up to a degree sideways, in nods, which
// raised brows look like, by one to two degrees and in scale by 1 to 3 %.
constexpr HeadPose head_deviation{.nod = 0.03, .turn = 0.02, .tilt = 0.02, .log_scale = 0.03};

// What the rigid points count beside it, as a share of what they do alone: where a head turns, corners of eyes and tip
// of the nose look otherwise, and are a pixel and more off (1.2 in place of 0.7 px).
constexpr double share_beside_head = 0.34;

// Of the scale of a head that talks: it nods and turns more than it comes nearer, and what is taken for scale is mostly
// a nod, which moves the mouth by as much as the face is long.
constexpr double leaning_deviation = 0.02;

// The rigid points of a frame, in the order of their names.
struct RigidPoints {
  std::vector<Point> places;
  std::vector<bool> seen;

  bool all() const { return !seen.empty() && std::find(seen.begin(), seen.end(), false) == seen.end(); }
  Point mean_of(const std::vector<std::size_t>& points) const {
    Point sum = 0;
    for (const std::size_t i : points) sum += places[i];
    return sum / static_cast<double>(points.size());
  }
};

RigidPoints rigid_points(const Landmarks& here, const std::vector<std::string>& names) {
  RigidPoints rigid;
  for (const std::string& name : names) {
    const Landmark* point = find_landmark(here, name);
    rigid.seen.push_back(point != nullptr && point->valid);
    rigid.places.push_back(rigid.seen.back() ? Point(point->x_px, point->y_px) : Point(0));
  }
  return rigid;
}

// Where frame t does not see all of them: from the nearest frames before and after that do, going evenly from the one
// to the other and with the points that are seen all the while. A point that is lost in some frame between the two is
// not believed in the others: lids carry the corner of an eye along before it is noticed.
RigidPoints bridge(const std::vector<RigidPoints>& frames, std::size_t t) {
  RigidPoints here = frames[t];
  if (here.all()) return here;
  const std::size_t first = t - std::min(t, bridge_reach), last = std::min(t + bridge_reach, frames.size() - 1);
  std::size_t before = t, after = t;
  while (before > first && !frames[before].all()) --before;
  while (after < last && !frames[after].all()) ++after;
  const bool has_before = frames[before].all(), has_after = frames[after].all();
  if (!has_before && !has_after) return here;
  std::vector<std::size_t> anchors, now;
  for (std::size_t i = 0; i < here.seen.size(); ++i) {
    bool always = true;
    for (std::size_t k = before; k <= after; ++k) always = always && frames[k].seen[i];
    if (always) anchors.push_back(i);
    if (here.seen[i]) now.push_back(i);
  }
  if (anchors.empty()) anchors = now;
  if (anchors.empty()) return here;
  const double span = static_cast<double>(after - before);
  const double share = !has_before ? 1 : !has_after ? 0 : static_cast<double>(t - before) / span;
  for (std::size_t i = 0; i < here.seen.size(); ++i) {
    if (std::find(anchors.begin(), anchors.end(), i) != anchors.end()) continue;
    Point off = 0;
    if (has_before) off += (1 - share) * (frames[before].places[i] - frames[before].mean_of(anchors));
    if (has_after) off += share * (frames[after].places[i] - frames[after].mean_of(anchors));
    here.places[i] = here.mean_of(anchors) + off;
    here.seen[i] = true;
  }
  return here;
}

// How much the frames t - away and t + away count for frame t, 0 to 1: their mean is where a head that moves evenly is
// in frame t. One of them alone stands for both at either end. Where a camera shakes, neighbours would carry the head's
// place, and with it the mouth, by as much as it shakes.
double agreement(const std::vector<RigidPoints>& frames, std::size_t t, std::size_t away, double size_px) {
  const bool has_before = t >= away && frames[t - away].all();
  const bool has_after = t + away < frames.size() && frames[t + away].all();
  if (!has_before && !has_after) return 0;
  double squares = 0;
  for (std::size_t i = 0; i < frames[t].places.size(); ++i) {
    const Point before = frames[has_before ? t - away : t + away].places[i];
    const Point after = frames[has_after ? t + away : t - away].places[i];
    squares += std::norm(0.5 * (before + after) - frames[t].places[i]);
  }
  const double off = std::sqrt(squares / static_cast<double>(frames[t].places.size())) / (trembling * size_px);
  return 1 / (1 + off * off * off * off);
}

// Root mean square distance of a frame's rigid points from their middle.
double size_of(const std::vector<Pair>& pairs) {
  Point middle = 0;
  for (const Pair& pair : pairs) middle += pair.from / static_cast<double>(pairs.size());
  double squares = 0;
  for (const Pair& pair : pairs) squares += std::norm(pair.from - middle);
  return std::sqrt(squares / static_cast<double>(pairs.size()));
}

std::vector<Pair> pairs_of(const RigidPoints& here, const Landmarks& rest, const Matrix* depths_px,
                           const StabiliseOptions& options, double weight) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < options.rigid.size(); ++i) {
    const Landmark* to = find_landmark(rest, options.rigid[i]);
    check(to != nullptr, "rest has no point ", options.rigid[i], ", expected all rigid ones");
    const double depth_px =
        depths_px == nullptr ? 0 : depths_px->at(static_cast<std::size_t>(to - rest.points.data()), 0);
    if (here.seen[i]) pairs.push_back({here.places[i], {to->x_px, to->y_px}, weight, depth_px});
  }
  return pairs;
}

std::optional<LikelyPose> likely_pose(const Matrix* head) {
  if (head == nullptr || head->values.empty()) return std::nullopt;  // nobody knows the head
  const HeadSight sight = head_sight(*head);
  if (sight.likeness < head_is_seen) return std::nullopt;
  LikelyPose likely{sight.pose, head_deviation};
  const double seen_share = 1 / (1 + std::pow(likely.deviation.log_scale / leaning_deviation, 2));
  likely.mean.log_scale *= seen_share;
  likely.deviation.log_scale *= std::sqrt(seen_share);
  return likely;
}

}  // namespace

Landmarks stabilise(const engine::Window<Landmarks>& landmarks, const Landmarks& rest, const Matrix* depths_px,
                    const Matrix* head, const StabiliseOptions& options) {
  check(!options.rigid.empty(), "rigid names no point");
  check(options.smooth_frames >= 0, "smooth_frames is ", options.smooth_frames, ", expected at least 0");
  if (depths_px != nullptr)
    check(depths_px->rows == rest.points.size() && depths_px->columns == 1 &&
              depths_px->values.size() == rest.points.size(),
          "depths_px is ", depths_px->rows, " x ", depths_px->columns,
          depths_px->values.size() == depths_px->rows * depths_px->columns ? "" : " with another number of values",
          ", expected ", rest.points.size(), " x 1 as rest has points");
  const std::optional<LikelyPose> likely = likely_pose(head);
  std::vector<RigidPoints> rigid;
  for (std::size_t i = 0; i < landmarks.size(); ++i) rigid.push_back(rigid_points(landmarks[i], options.rigid));
  const std::size_t centre = landmarks.centre_index();
  std::vector<Pair> pairs = pairs_of(bridge(rigid, centre), rest, depths_px, options, 1);
  Landmarks moved = landmarks.centre();
  if (pairs.empty()) {
    for (Landmark& point : moved.points) point.valid = false;
    return moved;
  }
  const bool solid = depths_px != nullptr && pairs.size() >= (likely ? 1 : 2);
  const auto own = static_cast<double>(pairs.size());
  const std::size_t first = centre - std::min(centre, smoothing_reach);
  const std::size_t last = std::min(centre + smoothing_reach, landmarks.size() - 1);
  std::vector<RigidPoints> bridged(rigid.size());
  for (std::size_t i = first; i <= last; ++i) bridged[i] = bridge(rigid, i);
  const double size_px = size_of(pairs);
  for (std::size_t i = first; i <= last && options.smooth_frames > 0; ++i) {
    if (i == centre) continue;
    const double frames = (static_cast<double>(i) - static_cast<double>(centre)) / options.smooth_frames;
    const std::size_t away = i < centre ? centre - i : i - centre;
    const double believed = bridged[centre].all() && size_px > 0 ? agreement(bridged, centre, away, size_px) : 1;
    const std::vector<Pair> more =
        pairs_of(bridged[i], rest, depths_px, options, believed * std::exp(-0.5 * frames * frames));
    if (more.size() == options.rigid.size()) pairs.insert(pairs.end(), more.begin(), more.end());
  }
  double total = 0, size = 0;
  Point from = 0, to = 0, along = 0;
  for (const Pair& pair : pairs) {
    total += pair.weight;
    from += pair.weight * pair.from;
    to += pair.weight * pair.to;
  }
  from /= total;
  to /= total;
  for (const Pair& pair : pairs) {
    along += pair.weight * (pair.to - to) * std::conj(pair.from - from);
    size += pair.weight * std::norm(pair.from - from);
  }
  const Point turn = size > 1 && std::abs(along) > 0 ? along / size : Point(1);
  SolidHead posed;
  if (solid) {
    std::vector<SolidPoint> points;
    // Neighbours calm the points, but what a point is off by it is off by in all of them: beside the whole head they
    // are no surer together than one frame.
    const double sure = likely ? share_beside_head * own / total : 1;
    for (const Pair& pair : pairs) points.push_back({pair.to, pair.from, pair.depth_px, sure * pair.weight});
    posed = find_solid_head(points, 1.0 / turn, likely ? &*likely : nullptr);
  }
  for (Landmark& point : moved.points) {
    const Landmark* at_rest = find_landmark(rest, point.name);
    const bool placed = solid && at_rest != nullptr;
    const Point here(point.x_px, point.y_px);
    const Point at = placed
                         ? posed.at_rest(here, depths_px->at(static_cast<std::size_t>(at_rest - rest.points.data()), 0))
                         : to + turn * (here - from);
    point.x_px = at.real();
    point.y_px = at.imag();
  }
  for (const std::string& name : options.rigid)
    for (Landmark& point : moved.points)
      if (point.name == name) point = {name, find_landmark(rest, name)->x_px, find_landmark(rest, name)->y_px, true};
  return moved;
}

}  // namespace face::track
