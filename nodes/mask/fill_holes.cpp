// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/fill_holes.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/scan_points.h"

namespace face::mask {
namespace {

struct Filling {
  std::vector<float> depth_mm;  // 0 = none
  std::vector<float> nearness;  // 1 / distance to the nearer end, px
};

// Along lines of `length` pixels that are `step` apart in memory.
void fill_line(const std::vector<float>& depth_mm, std::size_t start, std::size_t step, int length,
               const FillHolesOptions& options, Filling& out) {
  int last = -1;
  for (int k = 0; k < length; ++k) {
    const float here = depth_mm[start + static_cast<std::size_t>(k) * step];
    if (!(here > 0)) continue;
    const int gap = k - last - 1;
    if (last >= 0 && gap > 0 && gap <= options.longest_px) {
      const float there = depth_mm[start + static_cast<std::size_t>(last) * step];
      if (std::fabs(static_cast<double>(here - there)) <= options.largest_step_mm)
        for (int m = last + 1; m < k; ++m) {
          const std::size_t i = start + static_cast<std::size_t>(m) * step;
          const float share = static_cast<float>(m - last) / static_cast<float>(k - last);
          out.depth_mm[i] = there + share * (here - there);
          out.nearness[i] = 1.0f / static_cast<float>(std::min(m - last, k - m));
        }
    }
    last = k;
  }
}

}  // namespace

FillHolesResult fill_holes(const DepthScan& scan, const FillHolesOptions& options) {
  check_scan(scan, "scan");
  const int width = scan.picture.width, height = scan.picture.height;
  const std::size_t count = scan.depth_mm.size();
  Filling rows{std::vector<float>(count, 0), std::vector<float>(count, 0)}, columns = rows;
  for (int y = 0; y < height; ++y)
    fill_line(scan.depth_mm, static_cast<std::size_t>(y) * static_cast<std::size_t>(width), 1, width, options, rows);
  if (options.vertical_too)
    for (int x = 0; x < width; ++x)
      fill_line(scan.depth_mm, static_cast<std::size_t>(x), static_cast<std::size_t>(width), height, options, columns);
  FillHolesResult result{scan, {width, height, 1, std::vector<std::uint8_t>(count, 0)}};
  for (std::size_t i = 0; i < count; ++i) {
    if (scan.depth_mm[i] > 0 || !(rows.depth_mm[i] > 0)) continue;
    const float a = rows.nearness[i], b = columns.nearness[i];
    result.scan.depth_mm[i] = (a * rows.depth_mm[i] + b * columns.depth_mm[i]) / (a + b);
    result.filled.pixels[i] = 255;
  }
  return result;
}

}  // namespace face::mask
