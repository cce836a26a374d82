// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <array>

#include "nodes/track/patch.h"
#include "nodes/types/image.h"

namespace face::track {

// The smallest box about places in a picture.
struct Box {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;

  void include(double x_px, double y_px) {
    left = std::min(left, x_px), right = std::max(right, x_px);
    top = std::min(top, y_px), bottom = std::max(bottom, y_px);
  }
};

// Part of a picture in colours that tell lips from skin, teeth and the hollow of the mouth. Bilinear; outside, the
// nearest pixel's.
class FaceColours {
 public:
  // The box, margin_px larger on every side, as far as the image goes.
  FaceColours(const Image& image, const Box& box, double margin_px);
  // log((R+8)/(G+8)), log((B+8)/(G+8)) (both 0 in a grey image) and luma, 0 to 1. Places are the image's.
  std::array<double, 3> at(double x_px, double y_px) const;
  double luma_at(double x_px, double y_px) const;

 private:
  Grey red_, blue_, luma_;
  double left_ = 0, top_ = 0;  // place of the box's first pixel
};

}  // namespace face::track
