// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <memory>
#include <string>

#include "nodes/decode/av_input.h"
#include "nodes/decode/rgb_frame.h"
#include "nodes/types/image.h"

namespace face::decode {

// How a stored picture is brought upright: rows and columns exchanged, and then columns or rows read from their end.
struct Orientation {
  bool exchanged = false, columns_back = false, rows_back = false;
};

// Makes 8-bit sRGB pictures of a film's frames, turned upright where the file says so. input: has to outlive it.
class UprightImages {
 public:
  UprightImages(const AvInput& input, std::string title);
  // Throws where it is of another size than the first; number: what messages call it.
  Image image_of(const AVFrame& frame, std::size_t number);

 private:
  const AvInput& input_;
  std::string title_;
  std::unique_ptr<RgbConverter> converter_;
  Orientation orientation_;
};

}  // namespace face::decode
