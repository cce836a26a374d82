// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/landmarks.h"

namespace face::decode {

struct ReadLandmarksResult {
  Landmarks landmarks;              // in the file's order
  std::int64_t image_width_px = 0;  // of the image they were placed on
  std::int64_t image_height_px = 0;
};

// Reads points placed on an image: {"image_size": [width, height], "points": {"name": [x, y], ...}}, in pixels, (0, 0)
// the centre of the top left one. Throws where a point lies outside the image.
ReadLandmarksResult read_landmarks(const engine::File& file);

}  // namespace face::decode
