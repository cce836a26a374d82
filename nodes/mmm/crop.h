// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"

namespace face::mmm {

struct CropOptions {
  int left_px = 0;
  int top_px = 0;
  int width_px = 64;
  int height_px = 48;
};

// A part of a picture, of any number of channels. Throws where the part does not lie within it.
Image crop(const Image& image, const CropOptions& options = {});

}  // namespace face::mmm
