// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

#include "nodes/types/image.h"
#include "nodes/types/vec.h"

namespace face::model {

// A picture at one size, as numbers in [0, 1] over its exposure.
struct PictureLevel {
  int width = 0, height = 0;
  double factor = 1;           // of its size over the picture's
  std::vector<Vec3f> colours;  // per pixel: R G B
};

// factor <= 1. Blurred a little, so that gradients reach as far as a pixel or two.
PictureLevel make_level(const Image& picture, double factor, double exposure = 1);

// The same at several sizes.
std::vector<PictureLevel> make_levels(const Image& picture, const std::vector<double>& factors, double exposure = 1);

// R G B between the pixels; what lies outside is as at the edge.
Vec3f colour_at(const PictureLevel& level, double x_px, double y_px);

// R G B between the pixels, then d/dx of them, then d/dy by central differences; what lies outside is as at the edge.
std::array<float, 9> sample_at(const PictureLevel& level, double x_px, double y_px);

}  // namespace face::model
