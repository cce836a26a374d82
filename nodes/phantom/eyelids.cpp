// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/eyelids.h"

#include <array>
#include <numbers>

#include "nodes/phantom/head_surface.h"
#include "nodes/phantom/skin_layout.h"

namespace face::phantom {
namespace {

constexpr double kOuterReach = 17.6, kInnerReach = 16.0;  // corners from the eye's centre, mm
constexpr double kUpperHeight = 6.7, kLowerHeight = 5.7;  // of the opening, above and below the line of the corners
constexpr double kOuterRise = 1.0;                        // the outer corner lies above the inner one
constexpr double kOuterZ = 83.5, kInnerZ = 89.5;

// Rings from the inner edge of the lid outwards: distance from the lid's inner edge in the frontal plane,
// clearance over the eyeball, and how far the ring belongs to the face's surface already.
struct LidRing {
  double upper_mm, lower_mm, clearance_mm, of_face;
};
constexpr std::array<LidRing, 5> kLidRings = {
    {{0, 0, 0.35, 0}, {1.0, 0.9, 1.7, 0}, {3.2, 2.4, 2.2, 0.05}, {5.6, 4.6, 1.3, 0.25}, {7.6, 7.4, 1.5, 0.6}}};

}  // namespace

double lid_position(int column) {
  const double t = (column <= kEyeColumns / 2 ? column : kEyeColumns - column) / (0.5 * kEyeColumns);
  return 0.5 * (1 - 2 * t) + 0.5 * std::cos(std::numbers::pi * t);
}

int lid_side(int column) { return column % (kEyeColumns / 2) == 0 ? 0 : column < kEyeColumns / 2 ? 1 : -1; }

Vector3 lid_point(int ring, int column) {
  if (ring == kEyeDeepestRing)  // straight in, so that no gap shows between lid and eyeball, nor in the corners
    return kEyeCentre + (kEyeRadius - 0.6) * unit(lid_point(-1, column) - kEyeCentre);
  const LidRing& lid = kLidRings[static_cast<std::size_t>(ring + 1)];
  const double s = lid_position(column);
  const int side = lid_side(column);
  double x = s * (s > 0 ? kOuterReach : kInnerReach), y = kOuterRise * s;
  // The upper lid's highest place is a little towards the nose, the lower lid's lowest a little away from it.
  const double open = std::pow(std::max(0.0, 1 - std::pow(std::abs(s), 2.2)), 0.9);
  if (side > 0) y += kUpperHeight * open * (1 - 0.08 * s);
  if (side < 0) y -= kLowerHeight * open * (1 + 0.12 * s);
  const double angle = std::acos(std::clamp(s, -1.0, 1.0));
  const double away = side > 0 ? lid.upper_mm : side < 0 ? lid.lower_mm : 0.5 * (lid.upper_mm + lid.lower_mm);
  x += away * std::cos(angle) * 0.5;
  y += away * side * std::sin(angle);
  const double r = kEyeRadius + lid.clearance_mm, flat2 = r * r - x * x - y * y;
  const double ball = flat2 > 0 ? std::sqrt(flat2) : 0;
  const double corner = lerp(kInnerZ, kOuterZ, 0.5 + 0.5 * s) - kEyeCentre.z - (ring < 0 ? 0.8 : 0.0);
  const double gap = ball - corner;  // the larger of the two, rounded over 2 mm
  const double z = 0.5 * (ball + corner + std::sqrt(gap * gap + 1.0));
  const Vector3 on_ball = kEyeCentre + Vector3{x, y, z};
  // The fold of the lid runs out towards the corners, where the skin joins the face sooner.
  const double of_face = ring < 1 ? lid.of_face : lerp(lid.of_face, 0.25 * ring + 0.1, std::pow(std::abs(s), 6));
  return lerp(on_ball, skin_point(to_chart(on_ball)), of_face);
}

}  // namespace face::phantom
