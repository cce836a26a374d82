// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/mmm/fit_perspective.h"
#include "nodes/types/image.h"
#include "nodes/types/matrix.h"

namespace face::mmm {

struct NormaliseOptions {
  bool half_size = true;  // flow of pictures of half the width and height
  bool refine = true;     // the plane is made right by the pictures themselves, at full size
  double outlier_px = 0.5;
  std::int64_t levels = 5;  // of flow.robust
  std::int64_t coarse_warps = 3;
  std::int64_t fine_warps = 2;
};

// How a head has moved since the first frame, as if it were a plane (Speech-Driven 3D Facial Animation, section 3.1):
// robust flow from the reference, on pictures of half the size, and of the pixels within the mask the planar
// perspective that explains it (fit_perspective). Only the part of the pictures about the mask is looked at. Differs
// from the paper: the flow's plane is where refine_perspective starts. reference, frame, mask: one size. The result is
// for pixels of the whole size: warp_perspective holds the frame still with it.
FitPerspectiveResult normalise(const Image& reference, const Image& frame, const Image* mask,
                               const NormaliseOptions& options = {});

}  // namespace face::mmm
