// SPDX-License-Identifier: Apache-2.0
// Closed curves in a picture.
#pragma once
#include <array>
#include <cmath>
#include <vector>

namespace face::transfer {

using Place = std::array<double, 2>;  // x, y in a picture, pixels

inline Place operator+(const Place& a, const Place& b) { return {a[0] + b[0], a[1] + b[1]}; }
inline Place operator-(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1]}; }
inline Place operator*(double s, const Place& a) { return {s * a[0], s * a[1]}; }
inline double length(const Place& a) { return std::hypot(a[0], a[1]); }

// Where on the segment from a to b a place is nearest: 0 at a, 1 at b.
double along(const Place& a, const Place& b, const Place& place);

// A closed curve, by its corners.
struct Outline {
  std::vector<Place> corners;
  // How far a place is from the curve, negative inside; nearest: on the curve.
  double distance(const Place& place, Place* nearest = nullptr) const;
};

// What a curve's corners span.
struct Box {
  double left = 1e30, top = 1e30, right = -1e30, bottom = -1e30;
};
Box box_of(const Outline& outline);

// An opening's own directions: along it, from corner to corner, to the right, and across it, downwards. Lengths about
// an opening are shares of its own, so that they mean the same in a picture of any size.
struct OpeningAxis {
  Place middle{}, along = {1, 0};
  double length = 0;  // pixels
  // A place as x along and y across from the middle, and back.
  Place own(const Place& place) const;
  Place picture(const Place& own) const;
};
// By the second moments of the outline's corners.
OpeningAxis opening_axis(const Outline& outline);

}  // namespace face::transfer
