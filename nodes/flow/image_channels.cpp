// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/image_channels.h"

#include "nodes/base/check.h"
#include "nodes/base/luma.h"

namespace face::flow {
namespace {

std::size_t pixels_of(const Image& image, const char* name) {
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  check(image.pixels.size() == count * static_cast<std::size_t>(image.channels), name, " has ", image.pixels.size(),
        " bytes, expected ", image.width, " x ", image.height, " x ", image.channels);
  return count;
}

}  // namespace

void write_grey(const Image& image, float* values) {
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* p = image.pixels.data() + i * channels;
    values[i] = grey_value<float>(p, image.channels);
  }
}

FeatureMap image_channels(const Image& image, const Image* mask, const ImageChannelsOptions& options) {
  const std::size_t count = pixels_of(image, "image");
  FeatureMap map{image.width, image.height, {"grey"}, {}, {}};
  if (options.channels == Channels::grey) {
    map.values.resize(count);
    write_grey(image, map.values.data());
  } else {
    map.names = {"red", "green", "blue"};
    map.values.resize(3 * count);
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < count; ++i)
        map.values[c * count + i] = image.pixels[i * channels + (channels < 3 ? 0 : c)];
  }
  map.valid.assign(count, 1);
  if (mask) {
    pixels_of(*mask, "mask");
    check(mask->width == image.width && mask->height == image.height, "mask is ", mask->width, " x ", mask->height,
          " pixels, image ", image.width, " x ", image.height);
    for (std::size_t i = 0; i < count; ++i)
      map.valid[i] = mask->pixels[i * static_cast<std::size_t>(mask->channels)] < 128 ? 0 : 1;
  }
  return map;
}

}  // namespace face::flow
