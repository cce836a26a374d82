// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "nodes/decode/scan_camera_file.h"
#include "nodes/types/depth_scan.h"

namespace face::decode {

// Where the files of one frame are; empty where it has none of the kind.
struct FramePaths {
  std::string depth, cloud, picture, mask;
};

struct DepthFrame {
  DepthScan scan;
  double measured_px = 0;
  double median_depth_mm = 0;
  bool whole_numbers = false;  // its depth, which is in depth_unit_mm then
  double width_mm = 0;  // of what is measured, between its 5th and 95th percentile
};

// Reads one frame of a recorded stream (depth_take.h). Throws a message about what is wrong with it, without its
// number.
DepthFrame read_depth_frame(const FramePaths& paths, const ScanCameraFile& camera);

}  // namespace face::decode
