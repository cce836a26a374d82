// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/albedo_map.h"
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"
#include "nodes/types/table.h"

namespace face::evaluate {

struct MapDifferenceResult {
  Table table;    // row "all" sums up; its first column tells how far apart a and b are
  Image picture;  // a, b, and where they differ: black = equal, the largest difference = white
};

// Pixel by pixel, where both are known; maps of unequal size have NaN, and a picture of both alone.

// Depths along the camera's axis: mean_mm, p95_mm, largest_mm; only_in_a, only_in_b: pixels that one alone has
// measured; picture_rms_levels of the pictures (8 bits); same_camera, 1 or 0.
MapDifferenceResult depth_scan_difference(const DepthScan& a, const DepthScan& b);

// Radii, likewise; same_grid is 1 where axis, first row and steps are equal.
MapDifferenceResult cylinder_scan_difference(const CylinderScan& a, const CylinderScan& b);

// Reflectance (linear), of its three channels the one farthest apart: mean, p95, largest; only_in_a, only_in_b: pixels
// that one alone takes from pictures (weight > 0).
MapDifferenceResult albedo_difference(const AlbedoMap& a, const AlbedoMap& b);

}  // namespace face::evaluate
