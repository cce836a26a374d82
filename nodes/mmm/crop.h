// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::mmm {

struct CropOptions {
  int left_px = 0;
  int top_px = 0;
  int width_px = 64;
  int height_px = 48;
};

// A part of a picture, of any number of channels. landmarks: the part is the lower face (face_boxes.h), in place of
// options; may be null. Throws where the part does not lie within the picture, or a landmark is missing.
Image crop(const Image& image, const Landmarks* landmarks, const CropOptions& options = {});

}  // namespace face::mmm
