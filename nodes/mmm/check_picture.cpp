// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/check_picture.h"

#include "nodes/base/check.h"

namespace face::mmm {

void check_picture(const Image& image, const std::string& name) {
  check(image.width > 0 && image.height > 0 && image.channels == 3, name, " is ", image.width, " x ", image.height,
        " pixels of ", image.channels, " channels, expected a picture of 3");
  const std::size_t expected = 3u * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  check(image.pixels.size() == expected, name, " has ", image.pixels.size(), " bytes, expected ", expected);
}

void check_size(const Image& image, const std::string& name, const Image& model, const std::string& model_name) {
  check_picture(image, name);
  check(image.width == model.width && image.height == model.height, name, " is ", image.width, " x ", image.height,
        " pixels, ", model_name, " is ", model.width, " x ", model.height);
}

}  // namespace face::mmm
