// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/landmarks.h"

namespace face::track {

// Where a point was seen, and how surely: the information matrix of the place, 1/px^2. All zero where it was not seen.
struct Sighting {
  double x_px = 0;
  double y_px = 0;
  double xx = 0, xy = 0, yy = 0;
};

inline bool is_seen(const Sighting& place) { return place.xx + place.yy > 0; }
inline void forget(Sighting& place) { place.xx = place.xy = place.yy = 0; }

// A sighting of this error, equal in all directions.
inline Sighting sighted(double x_px, double y_px, double error_px) {
  return {x_px, y_px, 1 / (error_px * error_px), 0, 1 / (error_px * error_px)};
}

// The points at these places, one for each.
Landmarks places_of(Landmarks points, const std::vector<Sighting>& places);

// Adds one sighting to another: both are true within their errors.
void add(const Sighting& more, Sighting& place);

// A sighting may claim no smaller error than this.
void limit(double error_px, Sighting& place);

// Length of an error in the direction in which a sighting is sure, px: sqrt(e' I e / largest eigenvalue of I).
double sure_length_px(const Sighting& sighting, double dx_px, double dy_px);

}  // namespace face::track
