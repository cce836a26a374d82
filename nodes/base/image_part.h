// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"

namespace face {

// A part of a picture, of any number of channels; it has to lie within.
Image image_part(const Image& image, int left_px, int top_px, int width_px, int height_px);

// Half the width and height, each pixel the mean of four; a last odd row or column is left out. Pixel (i, j) of the
// result lies at (2 i + 0.5, 2 j + 0.5).
Image halve_image(const Image& image);

}  // namespace face
