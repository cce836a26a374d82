// SPDX-License-Identifier: Apache-2.0
// Where markers are in space, and which of them the jaw does not move.
#pragma once
#include <string>
#include <vector>

#include "nodes/types/depth_scan.h"
#include "nodes/types/landmarks.h"

namespace face::align {

struct MarkerPoint {
  std::string name;
  double x_px = 0;
  double y_px = 0;
  double depth_mm = 0;  // of a plane fitted to the 9 x 9 pixels about it
};

// The markers that are seen and have depth, by name.
std::vector<MarkerPoint> marker_points(const DepthScan& scan, const Landmarks& markers);

}  // namespace face::align
