// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/lips.h"

#include <array>
#include <numbers>

#include "nodes/phantom/skin_layout.h"

namespace face::phantom {
namespace {

// The mouth's proportions, mm.
constexpr double kMiddleY = -34, kMiddleZ = 112.5;  // where the lips touch in the middle plane
constexpr double kCornerRise = 2.6;                 // friendly: the corners lie above the middle
constexpr double kCornerBack = 12.0;                // and behind it
constexpr double kUpperHeight = 7.4, kLowerHeight = 9.2;
constexpr double kUpperBulge = 2.6, kLowerBulge = 3.4;

// Rings from the border of the red inwards: half width of the loop; along the red also how far from border to contact.
constexpr std::array<double, 5> kRedHalfWidth = {25.6, 25.2, 24.7, 24.1, 23.4};
constexpr std::array<double, 5> kRedFraction = {0, 0.27, 0.55, 0.80, 1};
// The mouth's lining: half width, depth behind the contact, and height above and below it in the middle plane.
struct Lining {
  double half_width, depth, above, below;
};
constexpr std::array<Lining, 7> kLining = {{{23.2, 2.6, 0.7, 0.8},
                                            {23.6, 4.6, 3.6, 3.8},
                                            {25.0, 5.6, 8.5, 9.0},
                                            {29.5, 8.0, 14.0, 15.5},
                                            {33.0, 22.0, 17.0, 20.0},
                                            {31.0, 40.0, 13.0, 17.0},
                                            {16.0, 54.0, 6.0, 9.0}}};

Vector3 contact_point(double s) {
  return {s, kMiddleY + kCornerRise * s * s - 0.5 * bell(s, 0.22), kMiddleZ - kCornerBack * std::pow(std::abs(s), 2.1)};
}

}  // namespace

double lip_position(int column) {
  const double t = (column <= 36 ? column : kMouthColumns - column) / 36.0;
  if (column == 18 || column == 54) return 0;
  return 0.6 * (1 - 2 * t) + 0.4 * std::cos(std::numbers::pi * t);
}

int lip_side(int column) { return column % 36 == 0 ? 0 : column < 36 ? 1 : -1; }

Vector3 lip_point(int ring, int column) {
  const double s = lip_position(column), thin = 1 - s * s;
  const int side = lip_side(column);
  Vector3 point = contact_point(s);
  if (ring >= kLipContactRing) {
    const auto k = static_cast<std::size_t>(-ring);
    const double t = kRedFraction[k];
    point.x = s * kRedHalfWidth[k];
    const double bow = 0.8 * bell(std::abs(s) - 0.25, 0.13) - 0.9 * bell(s, 0.12);
    const double upper = kUpperHeight * std::pow(thin, 0.72) + bow * thin, lower = kLowerHeight * std::pow(thin, 0.8);
    point.y += side * (1 - t) * (side > 0 ? upper : lower);
    const double border = side > 0 ? 0.6 : -1.2, bulge = side > 0 ? kUpperBulge : kLowerBulge;
    point.z += thin * ((1 - t) * border + 4 * t * (1 - t) * bulge) - (1 - t) * 0.6 * (1 - thin);
    return point;
  }
  const Lining& lining = kLining[static_cast<std::size_t>(kLipContactRing - 1 - ring)];
  point.x = s * lining.half_width;
  point.y += side * std::sqrt(thin) * (side > 0 ? lining.above : lining.below);
  point.z -= lining.depth;
  return point;
}

}  // namespace face::phantom
