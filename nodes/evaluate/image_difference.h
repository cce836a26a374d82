// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/table.h"

namespace face::evaluate {

struct ImageDifferenceResult {
  Table table;
  Image picture;  // a, b, and where they differ: black = equal, the largest difference = white
};

// Two pictures beside each other, in 8-bit sRGB values over pixels and the three channels (grey is repeated): row "all"
// with rms_levels (how far apart they are), largest_levels, differing_percent (of the pixels) and psnr_db. Pictures of
// unequal size have NaN there, and are shown beside each other alone.
ImageDifferenceResult image_difference(const Image& a, const Image& b);

}  // namespace face::evaluate
