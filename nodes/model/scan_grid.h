// SPDX-License-Identifier: Apache-2.0
// The vertices that a reference scan is sampled at: one fact for scan_mesh and sample_scan.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "nodes/types/depth_scan.h"
#include "nodes/types/vec.h"

namespace face::model {

struct ScanGrid {
  int columns = 0;
  int rows = 0;
  std::vector<std::int32_t> vertex;                     // rows x columns, -1 where nothing is measured
  std::vector<Vec2f> place_px;                          // V: where in the reference's picture
  std::vector<Vec3f> point_mm;                          // V: what was measured there, in the reference's world
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from the camera
};

// Measured pixels at every stride_px-th row and column, in reading order; neighbours of four make two triangles, of
// three one, unless an edge is longer than longest_edge_mm. Along an edge of the mesh (the lips, the outline) pixels
// make stairs: there places are smoothed along the edge, by less than a stride and not off the measured pixels.
ScanGrid scan_grid(const DepthScan& reference, int stride_px, double longest_edge_mm);

}  // namespace face::model
