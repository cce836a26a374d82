// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/skin_atlas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace face::model {
namespace {

std::vector<Vec2f> cylinder_uvs(const std::vector<Vec3f>& points) {
  Vec3f low = {1e9f, 1e9f, 1e9f}, high = {-1e9f, -1e9f, -1e9f};
  for (const Vec3f& p : points)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  const float middle_z = 0.5f * (low[2] + high[2]);
  std::vector<Vec2f> uvs;
  uvs.reserve(points.size());
  for (const Vec3f& p : points)
    uvs.push_back({0.5f + std::atan2(p[0], p[2] - middle_z) / (2 * std::numbers::pi_v<float>),
                   (p[1] - low[1]) / std::max(1e-6f, high[1] - low[1])});
  return uvs;
}

}  // namespace

SkinAtlas make_skin_atlas(const Mesh& mesh) {
  SkinAtlas atlas;
  const bool own = !mesh.corner_uvs.empty();
  atlas.uvs = own ? mesh.uvs : cylinder_uvs(mesh.points_mm);
  const auto add = [&](std::size_t first, std::size_t count) {
    for (std::size_t f = first; f < first + count; ++f)
      for (std::uint32_t c = mesh.polygon_starts[f] + 2; c < mesh.polygon_starts[f + 1]; ++c) {
        const std::uint32_t start = mesh.polygon_starts[f];
        const render::Triangle vertices = {mesh.corners[start], mesh.corners[c - 1], mesh.corners[c]};
        const render::Triangle corners =
            own ? render::Triangle{mesh.corner_uvs[start], mesh.corner_uvs[c - 1], mesh.corner_uvs[c]} : vertices;
        if (!own) {  // behind the head, where the angle jumps
          const auto [low, high] =
              std::minmax({atlas.uvs[corners[0]][0], atlas.uvs[corners[1]][0], atlas.uvs[corners[2]][0]});
          if (high - low > 0.5f) continue;
        }
        atlas.triangles.push_back(vertices);
        atlas.corners.push_back(corners);
      }
  };
  bool any = false;
  for (const Part& part : mesh.parts)
    if (part.name == "face") {
      any = true;
      add(part.first_polygon, part.polygon_count);
    }
  if (!any) add(0, mesh.polygon_count());
  return atlas;
}

std::vector<render::Triangle> uv_corners(const Mesh& mesh, const render::Triangulation& triangulation) {
  if (mesh.corner_uvs.empty()) return triangulation.triangles;
  std::vector<render::Triangle> corners;
  corners.reserve(triangulation.triangles.size());
  std::uint32_t fan = 0;
  for (std::size_t t = 0; t < triangulation.triangles.size(); ++t) {
    const std::uint32_t polygon = triangulation.polygons[t];
    fan = t > 0 && triangulation.polygons[t - 1] == polygon ? fan + 1 : 0;
    const std::uint32_t start = mesh.polygon_starts[polygon];
    corners.push_back({mesh.corner_uvs[start], mesh.corner_uvs[start + fan + 1], mesh.corner_uvs[start + fan + 2]});
  }
  return corners;
}

Vec3f TexelMap::weights_at(const SkinAtlas& atlas, int x, int y) const {
  const std::int32_t triangle = raster.triangles[raster.index(x, y)];
  return render::barycentrics_at(corners, atlas.corners[static_cast<std::size_t>(triangle)], static_cast<float>(x),
                                 static_cast<float>(y));
}

TexelMap map_texels(const SkinAtlas& atlas, int width, int height) {
  TexelMap map;
  for (const Vec2f& uv : atlas.uvs)
    map.corners.push_back(
        {uv[0] * static_cast<float>(width) - 0.5f, (1 - uv[1]) * static_cast<float>(height) - 0.5f, 1});
  render::RasterOptions options;
  options.width_px = width;
  options.height_px = height;
  options.near_mm = 0.5f;
  options.culling = render::Culling::none;
  map.raster = render::rasterize(map.corners, atlas.corners, options);
  return map;
}

}  // namespace face::model
