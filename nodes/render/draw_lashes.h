// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/render/rasterize.h"
#include "nodes/render/scene.h"

namespace face::render {

// The lashes of a scene have a raster of their own, no larger than they are.
struct Lashes {
  Raster raster;
  std::vector<ScreenPoint> screen;  // V, shifted
  int x0 = 0;                       // place in the picture's raster
  int y0 = 0;

  std::int32_t triangle_at(int x, int y) const {
    const int column = x - x0, row = y - y0;
    if (column < 0 || row < 0 || column >= raster.width_px || row >= raster.height_px) return -1;
    return raster.triangles[raster.index(column, row)];
  }
  // Whether the n x n samples from (x, y) may show one.
  bool touches(int x, int y, int n) const {
    return y + n > y0 && y < y0 + raster.height_px && x + n > x0 && x < x0 + raster.width_px;
  }
};

// whole: of the picture that they are drawn over.
Lashes draw_lashes(const Scene& scene, const RasterOptions& whole);

}  // namespace face::render
