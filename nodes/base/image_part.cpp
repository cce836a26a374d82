// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/image_part.h"

#include <cstddef>

namespace face {

Image image_part(const Image& image, int left_px, int top_px, int width_px, int height_px) {
  Image part{width_px, height_px, image.channels, {}};
  for (int y = 0; y < height_px; ++y) {
    const auto from = image.pixels.begin() + ((y + top_px) * image.width + left_px) * image.channels;
    part.pixels.insert(part.pixels.end(), from, from + width_px * image.channels);
  }
  return part;
}

Image halve_image(const Image& image) {
  Image half{image.width / 2, image.height / 2, image.channels, {}};
  const auto at = [&](int x, int y, int c) {
    return static_cast<int>(image.pixels[static_cast<std::size_t>((y * image.width + x) * image.channels + c)]);
  };
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < image.channels; ++c) {
        const int sum =
            at(2 * x, 2 * y, c) + at(2 * x + 1, 2 * y, c) + at(2 * x, 2 * y + 1, c) + at(2 * x + 1, 2 * y + 1, c);
        half.pixels.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
      }
  return half;
}

}  // namespace face
