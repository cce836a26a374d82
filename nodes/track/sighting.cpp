// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/sighting.h"

#include <algorithm>
#include <cmath>

namespace face::track {

Landmarks places_of(Landmarks points, const std::vector<Sighting>& places) {
  for (std::size_t i = 0; i < places.size(); ++i)
    points.points[i].x_px = places[i].x_px, points.points[i].y_px = places[i].y_px;
  return points;
}

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

void limit(double error_px, Sighting& place) {
  const double largest = (place.xx + place.yy) / 2 + std::hypot((place.xx - place.yy) / 2, place.xy);
  const double scale = largest > 0 ? std::min(1.0, 1 / (error_px * error_px * largest)) : 0;
  place.xx *= scale, place.xy *= scale, place.yy *= scale;
}

double sure_length_px(const Sighting& s, double dx_px, double dy_px) {
  const double mean = (s.xx + s.yy) / 2, largest = mean + std::hypot((s.xx - s.yy) / 2, s.xy);
  if (largest <= 0) return std::hypot(dx_px, dy_px);
  return std::sqrt(std::max(0.0, s.xx * dx_px * dx_px + 2 * s.xy * dx_px * dy_px + s.yy * dy_px * dy_px) / largest);
}

}  // namespace face::track
