// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/phantom/laser_scan.h"
#include "nodes/render/rasterize.h"

namespace face::phantom {

// The triangles of a head in the picture (phi, h): three corners of their own each, those across the seam twice.
struct UnrolledHead {
  std::vector<render::ScreenPoint> corners;
  std::vector<render::Triangle> triangles;
  std::vector<std::uint32_t> source;  // of every triangle
};

// As a scanner that goes round the axis sees it: x is the angle, y the height, 1 / depth grows outwards. left_out: of
// every triangle. Refuses a vertex that is a metre and more from the axis.
UnrolledHead unroll_head(const std::vector<Vec3f>& points_mm, const std::vector<render::Triangle>& triangles,
                         const std::vector<bool>& left_out, const LaserScanOptions& options);

}  // namespace face::phantom
