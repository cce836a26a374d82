// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "nodes/types/image.h"
#include "nodes/types/vec.h"

namespace face {

// A straight line with a direction.
struct Axis {
  Vec3f origin_mm = {0, 0, 0};
  Vec3f direction = {0, 1, 0};  // unit
};

// A scan around an axis, as laser scanners with a turning arm make it: r(h, phi) and colour. Row 0 is the top
// (h = top_mm along the axis from its origin), every row is step_mm lower. Column c looks at
// phi = (c - (columns - 1) / 2) * phi_step_rad: phi 0 is towards +z and positive towards +x, for a head its left.
struct CylinderScan {
  Axis axis;
  float top_mm = 150;
  float step_mm = 0.6f;
  float phi_step_rad = 0.01227f;  // 2 pi / 512
  Image picture;                  // RGB, rows x columns: the size of the scan
  std::vector<float> radius_mm;   // rows x columns, > 0; 0 = nothing measured
};

}  // namespace face
