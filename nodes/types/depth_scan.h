// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/camera.h"
#include "nodes/types/image.h"

namespace face {

// One frame of a 3D scanner that measures through a camera: the depth at every pixel, and the picture.
struct DepthScan {
  Camera camera;                // its frame is the scanner's when cam_from_world is the identity
  Image picture;                // grey or colour, registered with the depth; its size is the scan's
  std::vector<float> depth_mm;  // height x width along the camera's axis (not the ray), > 0; 0 = nothing measured
};

}  // namespace face
