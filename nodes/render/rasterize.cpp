// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/rasterize.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "nodes/base/check.h"

namespace face::render {
namespace {

constexpr int subpixel_bits = 8;
constexpr std::int64_t subpixels = 1 << subpixel_bits;
constexpr float max_coordinate_px = 1 << 20;  // beyond it (far outside any picture) snapping would overflow

// A vertex snapped to the subpixel grid.
struct Snapped {
  std::int32_t x = 0;
  std::int32_t y = 0;
  float inverse_depth = 0;  // 0 marks a vertex that cannot be drawn
};

struct Box {
  int x0, y0, x1, y1;  // inclusive
};

// The value of an edge function at a pixel centre and its steps from pixel to pixel; inside means >= 0.
template <class Int>
struct Edge {
  Int value;
  Int step_x;
  Int step_y;
};

// E(p) = cross(b - a, p - a) in a picture with y down is positive inside a triangle whose area is positive by the same
// formula. A pixel centre exactly on the edge counts when the edge is a left one (the interior lies to larger x, so
// E grows with x) or a top one (horizontal, interior below).
template <class Int>
Edge<Int> edge(const Snapped& a, const Snapped& b, const Box& box) {
  const std::int64_t x = box.x0 * subpixels;
  const std::int64_t y = box.y0 * subpixels;
  const std::int64_t dx = b.x - a.x;
  const std::int64_t dy = b.y - a.y;
  const std::int64_t value = dx * (y - a.y) - dy * (x - a.x);
  const bool top_left = dy < 0 || (dy == 0 && dx > 0);
  return {static_cast<Int>(value - (top_left ? 0 : 1)), static_cast<Int>(-dy * subpixels),
          static_cast<Int>(dx * subpixels)};
}

// A triangle ready to be filled: 1 / depth as a plane over the picture, and its number.
struct Filling {
  Box box;
  float plane_value, plane_x, plane_y;
  std::int32_t id;
};

// Pixel by pixel, for triangles of any size.
void fill_wide(const Snapped& a, const Snapped& b, const Snapped& c, const Filling& f, Raster& raster) {
  Edge<std::int64_t> e0 = edge<std::int64_t>(b, c, f.box), e1 = edge<std::int64_t>(c, a, f.box),
                     e2 = edge<std::int64_t>(a, b, f.box);
  for (int row = f.box.y0; row <= f.box.y1; ++row) {
    const float row_value = f.plane_value + f.plane_y * static_cast<float>(row);
    for (int x = f.box.x0; x <= f.box.x1; ++x) {
      const std::int64_t step = x - f.box.x0;
      const std::size_t pixel = raster.index(x, row);
      const float z = row_value + f.plane_x * static_cast<float>(x);
      const bool inside =
          ((e0.value + e0.step_x * step) | (e1.value + e1.step_x * step) | (e2.value + e2.step_x * step)) >= 0;
      if (inside && z > raster.inverse_depth_per_mm[pixel]) {
        raster.inverse_depth_per_mm[pixel] = z;
        raster.triangles[pixel] = f.id;
      }
    }
    e0.value += e0.step_y;
    e1.value += e1.step_y;
    e2.value += e2.step_y;
  }
}

constexpr int lanes = 8;
using Ints = std::int32_t __attribute__((vector_size(4 * lanes)));
using Floats = float __attribute__((vector_size(4 * lanes)));
constexpr Ints lane_numbers = {0, 1, 2, 3, 4, 5, 6, 7};

template <class V, class T>
V load(const T* place) {
  V value;
  std::memcpy(&value, place, sizeof value);
  return value;
}

// Eight pixels of a row at once; lanes right of the box keep what they hold. The compiler's vector types: no
// intrinsics, same arithmetic as fill_wide.
void fill_narrow(const Snapped& a, const Snapped& b, const Snapped& c, const Filling& f, Raster& raster) {
  Edge<std::int32_t> e0 = edge<std::int32_t>(b, c, f.box), e1 = edge<std::int32_t>(c, a, f.box),
                     e2 = edge<std::int32_t>(a, b, f.box);
  for (int row = f.box.y0; row <= f.box.y1; ++row) {
    const float row_value = f.plane_value + f.plane_y * static_cast<float>(row);
    float* depths = raster.inverse_depth_per_mm.data() + raster.index(0, row);
    std::int32_t* ids = raster.triangles.data() + raster.index(0, row);
    for (int x = f.box.x0; x <= f.box.x1; x += lanes) {
      const Ints step = lane_numbers + (x - f.box.x0);
      const Ints edges = (e0.value + e0.step_x * step) | (e1.value + e1.step_x * step) | (e2.value + e2.step_x * step);
      const Ints inside = (edges >= 0) & (lane_numbers <= f.box.x1 - x);
      const Floats z = row_value + f.plane_x * __builtin_convertvector(lane_numbers + x, Floats);
      const auto depth = load<Floats>(depths + x);
      const Ints drawn = inside & (z > depth);
      const Floats new_depth = drawn ? z : depth;
      const Ints new_ids = drawn ? Ints{} + f.id : load<Ints>(ids + x);
      std::memcpy(depths + x, &new_depth, sizeof new_depth);
      std::memcpy(ids + x, &new_ids, sizeof new_ids);
    }
    e0.value += e0.step_y;
    e1.value += e1.step_y;
    e2.value += e2.step_y;
  }
}

Snapped snap(const ScreenPoint& point, float near_mm) {
  Snapped snapped;
  const bool drawable = point.depth_mm >= near_mm && std::abs(point.x_px) < max_coordinate_px &&
                        std::abs(point.y_px) < max_coordinate_px;  // false for NaN as well
  if (!drawable) return snapped;
  snapped.x = static_cast<std::int32_t>(std::floor(point.x_px * static_cast<float>(subpixels) + 0.5f));
  snapped.y = static_cast<std::int32_t>(std::floor(point.y_px * static_cast<float>(subpixels) + 0.5f));
  snapped.inverse_depth = 1.0f / point.depth_mm;
  return snapped;
}

int ceil_to_pixel(std::int32_t value) { return static_cast<int>((value + subpixels - 1) >> subpixel_bits); }
int floor_to_pixel(std::int32_t value) { return static_cast<int>(value >> subpixel_bits); }

void draw(Snapped a, Snapped b, Snapped c, Culling culling, std::int32_t id, Raster& raster) {
  if (a.inverse_depth == 0 || b.inverse_depth == 0 || c.inverse_depth == 0) return;
  Box box;
  box.x0 = std::max(0, ceil_to_pixel(std::min({a.x, b.x, c.x})));
  box.x1 = std::min(raster.width_px - 1, floor_to_pixel(std::max({a.x, b.x, c.x})));
  box.y0 = std::max(0, ceil_to_pixel(std::min({a.y, b.y, c.y})));
  box.y1 = std::min(raster.height_px - 1, floor_to_pixel(std::max({a.y, b.y, c.y})));
  if (box.x0 > box.x1 || box.y0 > box.y1) return;
  std::int64_t area =
      static_cast<std::int64_t>(b.x - a.x) * (c.y - a.y) - static_cast<std::int64_t>(b.y - a.y) * (c.x - a.x);
  if (area == 0) return;
  // Counter-clockwise with y up is clockwise with y down, which makes this area negative.
  if (area > 0) {
    if (culling == Culling::back) return;
  } else {
    std::swap(b, c);
    area = -area;
  }
  // 1 / depth as a plane over the picture: value at pixel (0, 0) and slopes, in double so that large triangles stay
  // exact.
  const double scale = 1.0 / static_cast<double>(subpixels);
  const double bx = (b.x - a.x) * scale, by = (b.y - a.y) * scale, bz = b.inverse_depth - a.inverse_depth;
  const double cx = (c.x - a.x) * scale, cy = (c.y - a.y) * scale, cz = c.inverse_depth - a.inverse_depth;
  const double inverse_area = 1.0 / (bx * cy - by * cx);
  const double slope_x = (bz * cy - cz * by) * inverse_area;
  const double slope_y = (cz * bx - bz * cx) * inverse_area;
  const double origin = a.inverse_depth - slope_x * a.x * scale - slope_y * a.y * scale;
  const Filling filling = {box, static_cast<float>(origin), static_cast<float>(slope_x), static_cast<float>(slope_y),
                           id};
  // 32-bit edge functions suffice unless the triangle spans more than 110 pixels or so; the lanes may stick out of the
  // box by seven. At the very end of the picture they would stick out of memory.
  const std::int64_t spread = std::max({std::abs(a.x - b.x), std::abs(b.x - c.x), std::abs(c.x - a.x),
                                        std::abs(a.y - b.y), std::abs(b.y - c.y), std::abs(c.y - a.y)}) +
                              (lanes + 2) * subpixels;
  const bool small = 2 * spread * spread < std::numeric_limits<std::int32_t>::max();
  const bool in_memory = raster.index(box.x1, box.y1) + lanes <= raster.triangles.size();
  if (small && in_memory)
    fill_narrow(a, b, c, filling, raster);
  else
    fill_wide(a, b, c, filling, raster);
}

}  // namespace

void rasterize_into(const std::vector<ScreenPoint>& points, const std::vector<Triangle>& triangles,
                    const RasterOptions& options, Raster& raster) {
  check(options.width_px > 0 && options.height_px > 0, "the picture is ", options.width_px, " x ", options.height_px,
        " pixels, expected at least 1 x 1");
  check(options.near_mm > 0, "near_mm is ", options.near_mm, ", expected more than 0");
  raster.width_px = options.width_px;
  raster.height_px = options.height_px;
  const std::size_t count = static_cast<std::size_t>(options.width_px) * static_cast<std::size_t>(options.height_px);
  raster.triangles.assign(count, -1);
  raster.inverse_depth_per_mm.assign(count, 0.0f);
  std::vector<Snapped> snapped(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) snapped[i] = snap(points[i], options.near_mm);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& triangle = triangles[t];
    for (const std::uint32_t vertex : triangle)
      check(vertex < points.size(), "triangle ", t, " uses vertex ", vertex, " of ", points.size());
    draw(snapped[triangle[0]], snapped[triangle[1]], snapped[triangle[2]], options.culling,
         static_cast<std::int32_t>(t), raster);
  }
}

Raster rasterize(const std::vector<ScreenPoint>& points, const std::vector<Triangle>& triangles,
                 const RasterOptions& options) {
  Raster raster;
  rasterize_into(points, triangles, options, raster);
  return raster;
}

std::vector<Vec3f> barycentrics_of(const Raster& raster, const std::vector<ScreenPoint>& points,
                                   const std::vector<Triangle>& triangles) {
  std::vector<Vec3f> result(raster.triangles.size(), Vec3f{0, 0, 0});
  for (int y = 0; y < raster.height_px; ++y)
    for (int x = 0; x < raster.width_px; ++x) {
      const std::size_t pixel = raster.index(x, y);
      const std::int32_t triangle = raster.triangles[pixel];
      if (triangle >= 0)
        result[pixel] = barycentrics_at(points, triangles[static_cast<std::size_t>(triangle)], static_cast<float>(x),
                                        static_cast<float>(y));
    }
  return result;
}

}  // namespace face::render
