// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/feature_map.h"

namespace face::flow {

// Radius and grey value of a scan, channels "radius" (mm) and "grey" (0 to 255, BT.601 luma): what scans are matched by
// (Bargmann, Blanz and Seidel, Eqs. 1 and 2). The radius is the distance to the axis, which hardly changes along the
// cheeks. Differs from the paper: its Eq. 1 is for an axis along z; here the axis is given, by default upright through
// the origin. Pixels without depth are not valid.
FeatureMap scan_channels(const DepthScan& scan, const Axis* axis);

// The same of a scan around an axis, which has its radius already.
FeatureMap cylinder_channels(const CylinderScan& scan);

}  // namespace face::flow
