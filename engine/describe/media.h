// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace engine {

// How a browser shows a file with this suffix (".png"): "img", "audio", "video", "pre" (as text), or empty where it
// does not.
struct Media {
  std::string element;
  std::string mime;  // "image/png"; empty for a text
};
Media media_of(const std::string& suffix);

}  // namespace engine
