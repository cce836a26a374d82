// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/stabilise.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "nodes/base/check.h"
#include "nodes/base/find_landmark.h"
#include "nodes/track/solid_head.h"

namespace face::track {
namespace {

using Point = std::complex<double>;

struct Pair {
  Point from, to;
  double weight = 1;
  double depth_px = 0;  // of the point at rest
};

std::vector<Pair> pairs_of(const Landmarks& here, const Landmarks& rest, const Matrix* depths_px,
                           const StabiliseOptions& options, double weight) {
  std::vector<Pair> pairs;
  for (const std::string& name : options.rigid) {
    const Landmark* to = find_landmark(rest, name);
    check(to != nullptr, "rest has no point ", name, ", expected all rigid ones");
    const Landmark* from = find_landmark(here, name);
    const double depth_px =
        depths_px == nullptr ? 0 : depths_px->at(static_cast<std::size_t>(to - rest.points.data()), 0);
    if (from != nullptr && from->valid)
      pairs.push_back({{from->x_px, from->y_px}, {to->x_px, to->y_px}, weight, depth_px});
  }
  return pairs;
}

}  // namespace

Landmarks stabilise(const engine::Window<Landmarks>& landmarks, const Landmarks& rest, const Matrix* depths_px,
                    const StabiliseOptions& options) {
  check(!options.rigid.empty(), "rigid names no point");
  check(options.smooth_frames >= 0, "smooth_frames is ", options.smooth_frames, ", expected at least 0");
  if (depths_px != nullptr)
    check(depths_px->rows == rest.points.size() && depths_px->columns == 1 &&
              depths_px->values.size() == rest.points.size(),
          "depths_px is ", depths_px->rows, " x ", depths_px->columns,
          depths_px->values.size() == depths_px->rows * depths_px->columns ? "" : " with another number of values",
          ", expected ", rest.points.size(), " x 1 as rest has points");
  std::vector<Pair> pairs = pairs_of(landmarks.centre(), rest, depths_px, options, 1);
  Landmarks moved = landmarks.centre();
  if (pairs.empty()) {
    for (Landmark& point : moved.points) point.valid = false;
    return moved;
  }
  const bool solid = depths_px != nullptr && pairs.size() >= 2;
  const auto middle = static_cast<double>(landmarks.centre_index());
  for (std::size_t i = 0; i < landmarks.size() && options.smooth_frames > 0; ++i) {
    if (i == landmarks.centre_index()) continue;
    const double frames = (static_cast<double>(i) - middle) / options.smooth_frames;
    const std::vector<Pair> more = pairs_of(landmarks[i], rest, depths_px, options, std::exp(-0.5 * frames * frames));
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
  SolidHead head;
  if (solid) {
    std::vector<SolidPoint> points;
    for (const Pair& pair : pairs) points.push_back({pair.to, pair.from, pair.depth_px, pair.weight});
    head = find_solid_head(points, 1.0 / turn);
  }
  for (Landmark& point : moved.points) {
    const Landmark* at_rest = find_landmark(rest, point.name);
    const bool placed = solid && at_rest != nullptr;
    const Point here(point.x_px, point.y_px);
    const Point at = placed
                         ? head.at_rest(here, depths_px->at(static_cast<std::size_t>(at_rest - rest.points.data()), 0))
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
