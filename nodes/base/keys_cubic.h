// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

namespace face {

// What four samples in a row count at a share t, 0 to 1, of the way from the second to the third (Keys, Cubic
// Convolution Interpolation for Digital Image Processing, 1981, Eq. 15, a = -1/2).
template <class T>
std::array<T, 4> keys_weights(T t) {
  const T t2 = t * t, t3 = t2 * t;
  return {(-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2, (t3 - t2) / 2};
}

}  // namespace face
