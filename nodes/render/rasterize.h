// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/types/vec.h"

namespace face::render {

// A vertex in the picture: pixel (0, 0) is the centre of the top left one, x to the right, y down. depth_mm is the
// distance along the camera's axis, not along the ray.
struct ScreenPoint {
  float x_px = 0;
  float y_px = 0;
  float depth_mm = 0;
};

using Triangle = std::array<std::uint32_t, 3>;

enum class Culling { none, back };  // back: triangles that run clockwise in the picture are dropped

struct RasterOptions {
  int width_px = 640;
  int height_px = 640;
  float near_mm = 1;  // a triangle with a vertex nearer than this is dropped whole, there is no clipping
  Culling culling = Culling::back;
};

// What is seen through every pixel centre, rows from the top.
struct Raster {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::int32_t> triangles;      // index of the nearest triangle, -1 where there is none
  std::vector<float> inverse_depth_per_mm;  // 1 / depth, which is linear in the picture; 0 where there is nothing

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(x);
  }
};

// Finds the nearest triangle at every pixel centre. Vertices are snapped to 1/256 pixel and edges evaluated in
// integers, with the top-left rule of Direct3D and OpenGL: a pixel centre on an edge shared by two triangles belongs to
// exactly one of them. Of triangles at equal depth the first is kept, so the result does not depend on anything but its
// input. (Pineda, A Parallel Algorithm for Polygon Rasterization, SIGGRAPH 1988.) Differs from the paper: rows are
// walked in order, without tiles.
Raster rasterize(const std::vector<ScreenPoint>& points, const std::vector<Triangle>& triangles,
                 const RasterOptions& options = {});

// The same into an existing raster, whose memory is used again. A large picture costs more in fresh pages than in
// pixels.
void rasterize_into(const std::vector<ScreenPoint>& points, const std::vector<Triangle>& triangles,
                    const RasterOptions& options, Raster& raster);

// Perspective-correct barycentric coordinates of a pixel position in a triangle: an attribute there is
// sum_i b[i] * attribute[triangle[i]]. They sum to 1; outside the triangle some are negative.
inline Vec3f barycentrics_at(const std::vector<ScreenPoint>& points, const Triangle& triangle, float x_px, float y_px) {
  const ScreenPoint& a = points[triangle[0]];
  const ScreenPoint& b = points[triangle[1]];
  const ScreenPoint& c = points[triangle[2]];
  // Areas of the three sub-triangles, each over its vertex's depth (Heckbert and Moreton, Interpolation for Polygon
  // Texture Mapping and Shading, 1991): linear in the picture after division by depth.
  const float wa = ((b.x_px - x_px) * (c.y_px - y_px) - (b.y_px - y_px) * (c.x_px - x_px)) / a.depth_mm;
  const float wb = ((c.x_px - x_px) * (a.y_px - y_px) - (c.y_px - y_px) * (a.x_px - x_px)) / b.depth_mm;
  const float wc = ((a.x_px - x_px) * (b.y_px - y_px) - (a.y_px - y_px) * (b.x_px - x_px)) / c.depth_mm;
  const float sum = wa + wb + wc;
  if (sum == 0) return {1, 0, 0};
  const float inverse = 1.0f / sum;
  return {wa * inverse, wb * inverse, wc * inverse};
}

// barycentrics_at for every covered pixel (0 elsewhere), as analysis by synthesis wants them.
std::vector<Vec3f> barycentrics_of(const Raster& raster, const std::vector<ScreenPoint>& points,
                                   const std::vector<Triangle>& triangles);

}  // namespace face::render
