// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "engine/port.h"
#include "nodes/types/cylinder_scan.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"

namespace face::align {

struct CoverOptions {
  std::int64_t rows = 160;
  std::int64_t columns = 180;
  double top_mm = 130;
  double step_mm = 1.8;
};

// Where a scan has measured anything, in the cylindrical representation: grey, 255 where it has. Row 0 lies top_mm
// above the axis's origin, every row step_mm lower; the columns span phi from -90 to 90 degrees. Holes of up to two
// cells are closed; masked pixels inside the face (the mouth) may be given as filled.
Image cover(const DepthScan& scan, const Axis& axis, const CoverOptions& options = {});

struct CommonCoverOptions {
  double share = 0.98;
  std::int64_t shrink_cells = 2;
};

// What (nearly) all scans have measured: white where at least `share` of them have, less a border of shrink_cells
// (edges of a scan are its worst part). Only the largest connected piece is kept.
Image common_cover(const engine::Seq<Image>& covers, const CommonCoverOptions& options = {});

// Leaves of a scan what lies within a mask in the cylindrical representation. options: as the mask was made.
DepthScan crop(const DepthScan& scan, const Axis& axis, const Image& mask, const CoverOptions& options = {});

}  // namespace face::align
