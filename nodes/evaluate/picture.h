// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/image.h"
#include "nodes/types/table.h"

namespace face::evaluate {

// Throws where the pictures differ in size or the mask is not of theirs. The pixels that count: mask >= 128 in its
// first channel, all without a mask.
std::vector<bool> counted_pixels(const Image& picture, const Image& truth, const Image* mask);

// A picture beside the true one, in 8-bit sRGB values over the pixels of the mask (null = all):
//   rms_levels       root mean square difference over pixels and the three channels (grey is repeated)
//   psnr_db          20 log10(255 / rms_levels); infinite for equal pictures
//   gradient_ratio   sum of squared central differences of the brightness (0.299 R + 0.587 G + 0.114 B) over that of
//   the
//                    truth; below 1 = blurred. Only pixels whose four neighbours count, too.
//   pixels           that counted
// One row, "all".
Table picture(const Image& picture, const Image& truth, const Image* mask);

}  // namespace face::evaluate
