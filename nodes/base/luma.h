// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

namespace face {

// Luma as of ITU-R BT.601: of red, green and blue.
inline constexpr std::array<double, 3> luma_weights = {0.299, 0.587, 0.114};

// Of gamma-coded numbers, in their own scale; of three equal ones exactly their value.
template <class T>
constexpr T luma(T red, T green, T blue) {
  return green + static_cast<T>(luma_weights[0]) * (red - green) + static_cast<T>(luma_weights[2]) * (blue - green);
}

// Of one pixel: of its first three channels, or the first where there are fewer.
template <class T, class Channel>
constexpr T grey_value(const Channel* pixel, int channels) {
  if (channels < 3) return static_cast<T>(pixel[0]);
  return luma(static_cast<T>(pixel[0]), static_cast<T>(pixel[1]), static_cast<T>(pixel[2]));
}

}  // namespace face
