// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/draw_lashes.h"

#include <algorithm>
#include <cmath>

namespace face::render {

Lashes draw_lashes(const Scene& scene, const RasterOptions& whole) {
  Lashes lashes;
  float x0 = 1e9f, y0 = 1e9f, x1 = -1e9f, y1 = -1e9f;
  for (const Triangle& t : scene.lashes.triangles)
    for (const std::uint32_t v : t) {
      x0 = std::min(x0, scene.screen[v].x_px);
      x1 = std::max(x1, scene.screen[v].x_px);
      y0 = std::min(y0, scene.screen[v].y_px);
      y1 = std::max(y1, scene.screen[v].y_px);
    }
  const auto inside = [](float value, int size) {
    return static_cast<int>(std::clamp(value, 0.0f, static_cast<float>(size)));
  };
  lashes.x0 = inside(std::floor(x0), whole.width_px);
  lashes.y0 = inside(std::floor(y0), whole.height_px);
  RasterOptions options = whole;
  options.width_px = inside(std::ceil(x1) + 1, whole.width_px) - lashes.x0;
  options.height_px = inside(std::ceil(y1) + 1, whole.height_px) - lashes.y0;
  if (options.width_px <= 0 || options.height_px <= 0) return lashes;
  lashes.screen = scene.screen;
  for (ScreenPoint& point : lashes.screen) {
    point.x_px -= static_cast<float>(lashes.x0);
    point.y_px -= static_cast<float>(lashes.y0);
  }
  lashes.raster = rasterize(lashes.screen, scene.lashes.triangles, options);
  return lashes;
}

}  // namespace face::render
