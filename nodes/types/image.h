// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

namespace face {

// An 8-bit sRGB image, rows from the top, channels interleaved (1 = grey, 3 = RGB, 4 = RGBA). Pixel (0, 0) is a centre.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<std::uint8_t> pixels;  // height x width x channels
};

}  // namespace face
