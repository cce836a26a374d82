// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/camera.h"

namespace face::decode {

// How a recorded stream is to be read: its camera and what the numbers of its pictures mean.
struct ScanCameraFile {
  Camera camera;
  double aspect = 1;  // fy / fx; rows are resampled so that pixels are square
  int width_px = 0;   // 0 where the file does not say
  int height_px = 0;
  double depth_unit_mm = 1;   // of a whole number in a depth picture
  double length_unit_mm = 1;  // of a float in a depth picture, and of points
  double rate_hz = 40;
  bool says_depth_unit = false;
  bool says_length_unit = false;
  bool says_rate = false;
  int mask_from = 1;  // a mask's pixel counts from this grey value on
};

// Reads {"fx": 525, "fy": 525, "cx": 319.5, "cy": 239.5, "width": 640, "height": 480, "depth_unit_mm": 0.1,
// "length_unit": "m", "rate_hz": 40, "mask_value": 255, "cam_from_world": [9 numbers], "position_mm": [3 numbers]};
// only fx, cx and cy are needed. Throws where a value cannot be: a focal length that is not positive, or a field of
// view outside 3 to 150 degrees, a centre outside the picture, distortion that is not 0 (pictures must be undistorted),
// a key that is nearly one of these. Other keys do not count.
ScanCameraFile read_scan_camera(const engine::File& file);

}  // namespace face::decode
