// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/jpeg_end.h"

#include <cstddef>

namespace face::decode {

bool has_jpeg_end(std::string_view jpeg) {
  constexpr unsigned char start_of_scan = 0xDA;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(jpeg[i]); };
  // Segments before the first scan may hold whole pictures (thumbnails): they are stepped over by their lengths.
  std::size_t at = 2;
  while (at + 4 <= jpeg.size() && byte(at) == 0xFF) {
    if (byte(at + 1) == start_of_scan) return jpeg.find("\xFF\xD9", at) != std::string_view::npos;
    at += byte(at + 1) == 0xFF ? 1 : 2 + 256 * std::size_t{byte(at + 2)} + byte(at + 3);
  }
  return false;
}

}  // namespace face::decode
