// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/image.h"
#include "nodes/types/matrix.h"

namespace face::mmm {

struct ImagePointsOptions {
  std::int64_t components = 15;
  std::int64_t thumbnail_px = 32;
  bool whiten = true;
};

// Every picture as a point among its principal components, for clustering (Ezzat, Geiger, Poggio, Trainable
// Videorealistic Speech Animation, SIGGRAPH 2002, section 4.2: 15 components, and distances of Mahalanobis).
// Differs from the paper: the components are those of small grey pictures, thumbnail_px wide, so that 18,000 frames
// take 60 MB and one pass. images: T of one size. Result: T x K, K <= components; whiten: divided by each component's
// deviation, whose distances are those of Mahalanobis.
Matrix image_points(const engine::Seq<Image>& images, const ImagePointsOptions& options = {});

}  // namespace face::mmm
