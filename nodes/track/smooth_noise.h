// SPDX-License-Identifier: Apache-2.0
// Noise of a picture, and less of it. Internal to the area; OpenCV stays out.
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/landmarks.h"

namespace face::track {

// Standard deviation of the noise about the points, grey values: of what the Laplacians along rows and columns leave of
// a picture (Immerkaer, Fast Noise Variance Estimation, Computer Vision and Image Understanding 64, 1996; differs from
// it: the median of their size instead of the mean, so that edges do not count).
double noise_level(const Image& image, const Landmarks& points);

// The image, smoothed by as much as it is noisy: not at all below a level that cameras have by day, by a bell of a
// pixel's standard deviation at twice of it, so that the patches of a noisy film still look like themselves.
Image smooth_noise(const Image& image, const Landmarks& points);
// The same without a copy where the picture is clean: the picture itself, else what is made in `room`.
const Image& without_noise(const Image& image, const Landmarks& points, Image& room);

}  // namespace face::track
