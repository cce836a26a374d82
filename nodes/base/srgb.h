// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

namespace face {

// sRGB's transfer function (IEC 61966-2-1), continued above 1, its derivative, and its inverse. Linear below the toe.
inline double srgb_of(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}
inline double srgb_slope(double linear) {
  return linear <= 0.0031308 ? 12.92 : 1.055 / 2.4 * std::pow(linear, 1 / 2.4 - 1);
}
// The derivative where srgb_of(linear) is known already, without another power.
inline double srgb_slope(double linear, double srgb) {
  return linear <= 0.0031308 ? 12.92 : (srgb + 0.055) / (2.4 * linear);
}
inline double linear_of(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }

}  // namespace face
