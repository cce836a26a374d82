// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::render {

struct DrawLandmarksOptions {
  double radius_px = 2.5;
};

// The frame as RGB with a dot on every point: green where it is tracked, a red ring where it is lost. Points outside
// the frame are left out. Dots grow with pictures that are wider or higher than 640 px, in which they would not be
// seen.
Image draw_landmarks(const Image& frame, const Landmarks& landmarks, const DrawLandmarksOptions& options = {});

}  // namespace face::render
