// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/image.h"

namespace face {

// A picture's grey between its pixels, as the cubic B-spline through them (Unser, Splines: A Perfect Fit for Signal and
// Image Processing, IEEE Signal Processing Magazine, 1999, box 2). Edges as steep as a lens leaves them keep their form
// when a picture is moved by parts of a pixel, which the cubic of sample_image wears down. In sRGB as it is: in light
// what is dark beside something bright would overshoot. Coefficients are found once per picture.
class GreySpline {
 public:
  explicit GreySpline(const Image& picture);  // of three channels or more the luma (BT.601)

  // 0 to 255, not rounded, and beyond where an edge overshoots. Outside the picture its edge goes on.
  double at(double x_px, double y_px) const;

 private:
  int width_, height_;
  std::vector<double> coefficients_;
};

}  // namespace face
