// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

#include "nodes/types/vec.h"

namespace face {

// A pinhole camera without distortion. In its frame x points right, y up and the axis looks along -z. A picture's pixel
// (0, 0) is the centre of its top left one, x to the right, y down.
struct Camera {
  std::array<float, 9> cam_from_world = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // rotation, rows
  Vec3f position_mm = {0, 0, 600};                                    // of the pinhole, in the world
  float focal_px = 1000;
  float centre_x_px = 319.5f;
  float centre_y_px = 319.5f;
};

}  // namespace face
