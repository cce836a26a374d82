// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

#include "nodes/types/image.h"

namespace face::model {

// A picture at one size with its gradient, as numbers in [0, 1] over its exposure.
struct PictureLevel {
  int width = 0, height = 0;
  double factor = 1;                          // of its size over the picture's
  std::vector<std::array<float, 9>> samples;  // per pixel: R G B, then d/dx of them, then d/dy
};

// factor <= 1. Blurred a little, so that gradients reach as far as a pixel or two. exposure: what numbers are
// divided by.
PictureLevel make_level(const Image& picture, double factor, double exposure = 1);

// A level's samples between its pixels; what lies outside is as at the edge.
std::array<float, 9> sample_at(const PictureLevel& level, double x_px, double y_px);

}  // namespace face::model
