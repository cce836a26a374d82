// SPDX-License-Identifier: Apache-2.0
// A smaller picture and the places in it. Internal to the area; OpenCV stays out.
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::track {

// How many pixels of a picture are one of the smaller picture, each way.
class Shrink {
 public:
  // For pictures of this size, `times` (at least 1) as large; both sides are whole numbers of pixels.
  Shrink(int width, int height, double times);

  bool is_none() const { return width_ == full_width_ && height_ == full_height_; }
  double times() const { return static_cast<double>(full_width_) / width_; }
  // Mean of what each pixel covers.
  Image image(const Image& full) const;
  // Pixel (0, 0) is the centre of the first one in both.
  Landmarks to_small(Landmarks points) const;
  Landmarks to_full(Landmarks points) const;

 private:
  int full_width_, full_height_, width_, height_;
};

}  // namespace face::track
