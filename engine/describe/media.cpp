// SPDX-License-Identifier: Apache-2.0
#include "engine/describe/media.h"

#include <algorithm>

namespace engine {

Media media_of(const std::string& suffix) {
  struct Known {
    const char *suffix, *element, *mime;
  };
  static constexpr Known known[] = {{".png", "img", "image/png"},
                                    {".jpg", "img", "image/jpeg"},
                                    {".jpeg", "img", "image/jpeg"},
                                    {".svg", "img", "image/svg+xml"},
                                    {".gif", "img", "image/gif"},
                                    {".webp", "img", "image/webp"},
                                    {".wav", "audio", "audio/wav"},
                                    {".mp4", "video", "video/mp4"},
                                    {".webm", "video", "video/webm"},
                                    {".txt", "pre", ""},
                                    {".csv", "pre", ""},
                                    {".json", "pre", ""},
                                    {".md", "pre", ""},
                                    {".TextGrid", "pre", ""},
                                    {".obj", "pre", ""},
                                    {".gltf", "pre", ""}};
  const auto found =
      std::find_if(std::begin(known), std::end(known), [&](const Known& one) { return suffix == one.suffix; });
  return found == std::end(known) ? Media{} : Media{found->element, found->mime};
}

}  // namespace engine
