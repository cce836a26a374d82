// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/image.h"

namespace face {

// The picture between its pixels, by the cubic of Keys (keys_cubic.h), which keeps an eye's edges where bilinear
// interpolation blurs them. Outside the picture its edge goes on. values: as many as channels, 0 to 255, not rounded.
void sample_image(const Image& image, double x_px, double y_px, float* values);

// Rounded and held within 0 to 255.
std::uint8_t to_byte(double value);

}  // namespace face
