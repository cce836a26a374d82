// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/camera.h"

namespace face::phantom {

struct MakeCameraOptions {
  int width_px = 640;
  int height_px = 480;
  double distance_mm = 1000;
  double target_x_mm = 0;  // the default is the middle of the embedded head's face
  double target_y_mm = 10;
  double target_z_mm = 80;
  double yaw_deg = 0;    // positive stands at the head's left
  double pitch_deg = 0;  // positive stands higher
  double field_of_view_deg = 17;
};

// A camera, or a projector, that looks at a point from a distance. In the world, y is up and a head at rest looks
// along +z. The field of view is the vertical one.
Camera make_camera(const MakeCameraOptions& options = {});

}  // namespace face::phantom
