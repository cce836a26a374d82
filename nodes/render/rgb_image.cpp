// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/rgb_image.h"

#include <algorithm>

#include "nodes/base/check.h"

namespace face::render {

Image rgb_image(const Image& image) {
  check(image.channels == 1 || image.channels == 3 || image.channels == 4, "the image has ", image.channels,
        " channels, expected 1, 3 or 4");
  const std::size_t count =
      static_cast<std::size_t>(std::max(0, image.width)) * static_cast<std::size_t>(std::max(0, image.height));
  const auto channels = static_cast<std::size_t>(image.channels);
  check(image.pixels.size() == count * channels, "the image has ", image.pixels.size(), " bytes, expected ",
        count * channels, " for ", image.width, " x ", image.height, " x ", image.channels);
  if (image.channels == 3) return image;
  Image rgb{image.width, image.height, 3, {}};
  rgb.pixels.resize(count * 3);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) rgb.pixels[i * 3 + c] = image.pixels[i * channels + (channels == 1 ? 0 : c)];
  return rgb;
}

}  // namespace face::render
