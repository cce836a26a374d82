// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>

#include "nodes/decode/scan_camera_file.h"
#include "nodes/decode/scan_projector_file.h"
#include "nodes/types/depth_scan.h"

namespace face::decode {

// Where the files of one frame are; empty where it has none of the kind.
struct FramePaths {
  std::string depth, cloud, picture, mask;
  std::array<std::string, 5> patterns;  // fringe pictures

  bool has_patterns() const {
    for (const std::string& path : patterns)
      if (!path.empty()) return true;
    return false;
  }
};

struct DepthFrame {
  DepthScan scan;
  double measured_px = 0;
  double median_depth_mm = 0;
  bool whole_numbers = false;  // its depth, which is in depth_unit_mm then
  double width_mm = 0;         // of what is measured, between its 5th and 95th percentile
};

// Reads one frame of a recorded stream (depth_take.h). projector: of fringe pictures, null = there is none. Throws a
// message about what is wrong with it, without its number.
DepthFrame read_depth_frame(const FramePaths& paths, const ScanCameraFile& camera,
                            const ScanProjectorFile* projector = nullptr);

}  // namespace face::decode
