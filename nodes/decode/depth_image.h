// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "nodes/types/image.h"

namespace face::decode {

// Numbers of a picture of one channel, as they are stored.
struct DepthImage {
  int width = 0;
  int height = 0;
  bool whole_numbers = true;  // of 8 or 16 bits; false: floats
  int bits = 0;               // of one number
  std::vector<float> values;  // height x width
};

// Reads a grey PNG of 8 or 16 bits, or an EXR (its grey channel, else the red one). `title` is what messages call it.
// Throws where it cannot be read or has colours of whole numbers.
DepthImage read_depth_image(const std::string& path, const std::string& title);

// The same of a mask, which may also be a colour picture: of every pixel the brightest channel, 8 bits.
DepthImage read_mask(const std::string& path, const std::string& title);

// Reads how bright pixels are, 0 to 255, one channel: of 8 or 16 bits, of floats of 0 to 1 (EXR), or the mean of
// colours.
Image read_levels(const std::string& path, const std::string& title);

// Reads a picture as 8-bit sRGB: grey stays grey, all else becomes RGB.
Image read_picture(const std::string& path, const std::string& title);

}  // namespace face::decode
