// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

#include "nodes/types/image.h"

namespace face::mmm {

// The picture between its pixels, by the cubic of Keys (Cubic Convolution Interpolation for Digital Image Processing,
// 1981, Eq. 15, a = -1/2), which keeps an eye's edges where bilinear interpolation blurs them. Outside the picture its
// edge goes on. values: as many as channels, 0 to 255, not rounded.
void sample_image(const Image& image, double x_px, double y_px, float* values);

// Rounded and held within 0 to 255.
std::uint8_t to_byte(double value);

// Throws unless the picture has pixels, three channels and as many bytes as that takes; `name` is told.
void check_picture(const Image& image, const std::string& name);

// The same, and of the size of `model`.
void check_size(const Image& image, const std::string& name, const Image& model, const std::string& model_name);

}  // namespace face::mmm
