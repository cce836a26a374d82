// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"

namespace face::texture {

// How unsharp a picture is where the mask (grey) is: the standard deviation, in pixels, of the Gaussian that makes a
// step an edge such as the strongest ones there (the ratio of an edge's slope to its slope after one more blur; Zhuo
// and Sim, Defocus Map Estimation from a Single Image, Pattern Recognition 2011, eq. 6, of all edges together). Never
// below that of the pixels themselves, and that where there is no edge.
double picture_blur_px(const Image& picture, const Image& mask);

}  // namespace face::texture
