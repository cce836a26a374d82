// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/head_view.h"

#include "nodes/base/pose.h"
#include "nodes/render/camera.h"

namespace face::phantom {

Camera camera_in_head(const Camera& camera, const RigidMotion* world_from_head) {
  if (world_from_head == nullptr) return camera;
  const auto& r = world_from_head->rotation;
  const auto& t = world_from_head->translation_mm;
  Camera moved = camera;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += camera.cam_from_world[3 * row + k] * r[3 * k + column];
      moved.cam_from_world[3 * row + column] = static_cast<float>(sum);
    }
  for (std::size_t column = 0; column < 3; ++column) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += r[3 * k + column] * (camera.position_mm[k] - t[k]);
    moved.position_mm[column] = static_cast<float>(sum);
  }
  return moved;
}

Vec3f direction_in_head(const Vec3f& direction_in_world, const RigidMotion* world_from_head) {
  if (world_from_head == nullptr) return direction_in_world;
  const auto& r = world_from_head->rotation;
  Vec3f turned;
  for (std::size_t column = 0; column < 3; ++column)
    turned[column] = static_cast<float>(r[column] * direction_in_world[0] + r[3 + column] * direction_in_world[1] +
                                        r[6 + column] * direction_in_world[2]);
  return turned;
}

Vec3f point_in_world(const Vec3f& point_in_head_mm, const RigidMotion* world_from_head) {
  if (world_from_head == nullptr) return point_in_head_mm;
  const auto& r = world_from_head->rotation;
  Vec3f moved;
  for (std::size_t row = 0; row < 3; ++row)
    moved[row] = static_cast<float>(r[3 * row] * point_in_head_mm[0] + r[3 * row + 1] * point_in_head_mm[1] +
                                    r[3 * row + 2] * point_in_head_mm[2] + world_from_head->translation_mm[row]);
  return moved;
}

bool is_lash(const Part& part) { return part.name.find("lash") != std::string::npos; }

OpaqueTriangles opaque_triangles(const Mesh& mesh) {
  std::vector<std::int32_t> first_of_polygon(mesh.polygon_count() + 1, 0);
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f) {
    const std::uint32_t corners = mesh.polygon_starts[f + 1] - mesh.polygon_starts[f];
    first_of_polygon[f + 1] = first_of_polygon[f] + static_cast<std::int32_t>(corners > 2 ? corners - 2 : 0);
  }
  const render::Triangulation all = render::triangulate(mesh);
  OpaqueTriangles opaque;
  std::uint32_t polygon = 0;
  std::int32_t within = 0;
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    within = t > 0 && all.polygons[t] == polygon ? within + 1 : 0;
    polygon = all.polygons[t];
    if (!mesh.parts.empty() && is_lash(mesh.parts[all.parts[t]])) continue;
    opaque.mesh.triangles.push_back(all.triangles[t]);
    opaque.mesh.polygons.push_back(polygon);
    opaque.mesh.parts.push_back(all.parts[t]);
    opaque.fan_index.push_back(first_of_polygon[polygon] + within);
  }
  return opaque;
}

HeadView view_head(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head, const Camera& camera,
                   int width_px, int height_px) {
  HeadView view;
  view.opaque = opaque_triangles(rig.neutral);
  view.screen = render::project(camera_in_head(camera, world_from_head), pose_points(rig, weights));
  render::RasterOptions raster_options;
  raster_options.width_px = width_px;
  raster_options.height_px = height_px;
  raster_options.culling = render::Culling::none;
  view.raster = render::rasterize(view.screen, view.opaque.mesh.triangles, raster_options);
  return view;
}

SurfaceMap map_of(const render::Raster& raster, const std::vector<render::ScreenPoint>& screen,
                  const OpaqueTriangles& opaque) {
  SurfaceMap map{raster.width_px, raster.height_px, raster.triangles, {}};
  map.weights.assign(raster.triangles.size(), Vec2f{0, 0});
  std::size_t pixel = 0;
  for (int y = 0; y < raster.height_px; ++y)
    for (int x = 0; x < raster.width_px; ++x, ++pixel) {
      if (raster.triangles[pixel] < 0) continue;
      const auto t = static_cast<std::size_t>(raster.triangles[pixel]);
      const Vec3f b =
          render::barycentrics_at(screen, opaque.mesh.triangles[t], static_cast<float>(x), static_cast<float>(y));
      map.triangle[pixel] = opaque.fan_index[t];
      map.weights[pixel] = {b[0], b[1]};
    }
  return map;
}

std::vector<render::Triangle> fan_triangles(const Mesh& mesh) { return render::triangulate(mesh, false).triangles; }

std::vector<std::uint16_t> part_of_vertices(std::size_t vertex_count, const render::Triangulation& mesh) {
  std::vector<std::uint16_t> parts(vertex_count, 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) parts[v] = mesh.parts[t];
  return parts;
}

}  // namespace face::phantom
