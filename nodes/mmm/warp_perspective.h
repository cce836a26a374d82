// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/matrix.h"

namespace face::mmm {

struct WarpPerspectiveOptions {
  bool inverse = false;
};

// The frame as it would be had the head not moved: pixel p shows the frame at perspective x p (cubic interpolation; the
// frame's edge goes on outside it). inverse: gives a head that was held still its motion back. perspective: 3 x 3, not
// singular, of mmm.normalise.
Image warp_perspective(const Image& frame, const Matrix& perspective, const WarpPerspectiveOptions& options = {});

}  // namespace face::mmm
