// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "nodes/base/check.h"
#include "nodes/types/image.h"

namespace face {

// Throws where an image is empty or has more or fewer values than its size says. name: of the port, as the error says
// it.
inline void check_image(const Image& image, const std::string& name) {
  const std::size_t expected = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                               static_cast<std::size_t>(image.channels);
  check(image.width > 0 && image.height > 0 && image.channels > 0 && image.pixels.size() == expected, name, " has ",
        image.pixels.size(), " values, expected ", image.width, " x ", image.height, " pixels of ", image.channels,
        " channels");
}

}  // namespace face
