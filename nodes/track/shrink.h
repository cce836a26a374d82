// SPDX-License-Identifier: Apache-2.0
// A smaller picture and the places in it. Internal to the area; OpenCV stays out.
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::track {

// How many pixels of a picture are one of the picture that is made of it, each way: a smaller one, as a rule.
class Shrink {
 public:
  // For pictures of this size, `times` as large, below 1 smaller; both sides are whole numbers of pixels.
  Shrink(int width, int height, double times);

  bool is_none() const { return width_ == full_width_ && height_ == full_height_; }
  double times() const { return static_cast<double>(full_width_) / width_; }
  // Mean of what each pixel covers; cubic where pictures are made larger.
  Image image(const Image& full) const;
  // A small picture as large as the others; cubic.
  Image full(const Image& small) const;
  // Pixel (0, 0) is the centre of the first one in both.
  Landmarks to_small(Landmarks points) const;
  Landmarks to_full(Landmarks points) const;

 private:
  int full_width_, full_height_, width_, height_;
};

// Share of the contrast about the points (and margin_px around them) that the smaller picture does not have, root mean
// square.
double lost_contrast(const Image& frame, const Shrink& shrink, const Landmarks& points, double margin_px);

}  // namespace face::track
