// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/feature_map.h"

namespace face::flow {

struct CylinderColoursOptions {
  double half_angle_deg = 110;
  double curvature_scale_mm = 0;  // 0 = no channel of curvature
};

// Radius and colour of a scan around an axis, channels "radius" (mm), "red", "green", "blue" (0 to 255): what laser
// scans are matched by (Blanz, Basso, Poggio, Vetter: Reanimating Faces in Images and Video, 2003, eq. 4; flow.scan
// gives the radius its weight, which the paper's sum of mm and grey levels leaves open). Pixels without radius, and
// those farther than half_angle_deg from the front, are not valid. Differs from the paper: with curvature_scale_mm a
// channel "curvature" (cylinder_curvature.h) follows, for what features of shape a skin has that differs from person to
// person in size and colour; pixels about which too little is measured are then not valid either.
FeatureMap cylinder_colours(const CylinderScan& scan, const CylinderColoursOptions& options = {});

}  // namespace face::flow
