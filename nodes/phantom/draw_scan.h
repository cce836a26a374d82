// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"

namespace face::phantom {

// What a scanner has measured, to look at: on the left the surface, lit from the upper right, holes dark red; on the
// right the scanner's picture.
Image draw_scan(const DepthScan& scan);

// The same of a cylindrical scan, over phi and h.
Image draw_laser_scan(const CylinderScan& scan);

}  // namespace face::phantom
