// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::mmm {

// Boxes are left, top, right, bottom as shares of the picture's width and height.
struct HeadMaskOptions {
  std::vector<double> head = {0.3, 0.06, 0.7, 0.78};    // an ellipse fills it
  std::vector<double> eyes = {0.34, 0.29, 0.66, 0.47};  // both, with the brows
  std::vector<double> mouth = {0.28, 0.575, 0.72, 1};   // with the chin, which the jaw moves
};

// Where a head moves as a whole (white): the head without eyes, brows, mouth and chin, as a picture of one channel.
// landmarks: take the place of the boxes (face_boxes.h says how); may be null. frame: gives the size. Throws where a box
// is not a box or a landmark is missing.
Image head_mask(const Image& frame, const Landmarks* landmarks, const HeadMaskOptions& options = {});

}  // namespace face::mmm
