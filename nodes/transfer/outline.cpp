// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace face::transfer {

double along(const Place& a, const Place& b, const Place& place) {
  const Place ab = b - a, ap = place - a;
  return std::clamp((ap[0] * ab[0] + ap[1] * ab[1]) / std::max(ab[0] * ab[0] + ab[1] * ab[1], 1e-12), 0.0, 1.0);
}

Box box_of(const Outline& outline) {
  Box box;
  for (const Place& p : outline.corners)
    box = {std::min(box.left, p[0]), std::min(box.top, p[1]), std::max(box.right, p[0]), std::max(box.bottom, p[1])};
  return box;
}

double Outline::distance(const Place& place, Place* nearest) const {
  double least = 1e30;
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Place &a = corners[j], &b = corners[i];
    const Place there = a + along(a, b, place) * (b - a);
    const double away = length(place - there);
    if (away < least) {
      least = away;
      if (nearest) *nearest = there;
    }
    if ((a[1] > place[1]) != (b[1] > place[1]) && place[0] < (b[0] - a[0]) * (place[1] - a[1]) / (b[1] - a[1]) + a[0])
      inside = !inside;
  }
  return inside ? -least : least;
}

Place OpeningAxis::own(const Place& place) const {
  const Place from = place - middle;
  return {from[0] * along[0] + from[1] * along[1], from[1] * along[0] - from[0] * along[1]};
}

Place OpeningAxis::picture(const Place& own) const {
  return {middle[0] + own[0] * along[0] - own[1] * along[1], middle[1] + own[0] * along[1] + own[1] * along[0]};
}

OpeningAxis opening_axis(const Outline& outline) {
  OpeningAxis axis;
  const auto count = static_cast<double>(outline.corners.size());
  for (const Place& p : outline.corners) axis.middle = axis.middle + (1 / count) * p;
  double xx = 0, xy = 0, yy = 0;
  for (const Place& p : outline.corners) {
    const Place from = p - axis.middle;
    xx += from[0] * from[0];
    xy += from[0] * from[1];
    yy += from[1] * from[1];
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);  // -90 to 90 degrees: to the right
  axis.along = {std::cos(angle), std::sin(angle)};
  double least = 0, most = 0;
  for (const Place& p : outline.corners) {
    least = std::min(least, axis.own(p)[0]);
    most = std::max(most, axis.own(p)[0]);
  }
  axis.length = most - least;
  return axis;
}

}  // namespace face::transfer
