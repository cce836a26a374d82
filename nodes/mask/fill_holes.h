// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "nodes/types/depth_scan.h"
#include "nodes/types/image.h"

namespace face::mask {

struct FillHolesOptions {
  std::int64_t longest_px = 130;
  double largest_step_mm = 25;
  bool vertical_too = false;
};

struct FillHolesResult {
  DepthScan scan;
  Image filled;  // grey: 255 where depth was filled in, else 0
};

// Closes holes in the depth of a scan by linear interpolation along its rows (Bargmann, Blanz and Seidel, section 2):
// a gap between two measured pixels of a row is filled where it is not longer than longest_px and its ends differ by no
// more than largest_step_mm in depth. With vertical_too a hole that has ends in its column as well gets the mean of
// both, weighted by nearness, so that rows do not show as streaks.
FillHolesResult fill_holes(const DepthScan& scan, const FillHolesOptions& options = {});

}  // namespace face::mask
