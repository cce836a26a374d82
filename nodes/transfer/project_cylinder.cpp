// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/project_cylinder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"
#include "nodes/render/rasterize.h"
#include "nodes/render/triangulate.h"
#include "nodes/transfer/lip_sides.h"

namespace face::transfer {
namespace {

constexpr float beyond_mm = 1000;  // more than any radius: what is nearer than this in the picture lies farther out

// Affine weights of a place in a triangle of the unrolled picture, where lengths have no perspective.
Vec3f weights_at(const render::ScreenPoint& a, const render::ScreenPoint& b, const render::ScreenPoint& c, float x,
                 float y) {
  const float wa = (b.x_px - x) * (c.y_px - y) - (c.x_px - x) * (b.y_px - y);
  const float wb = (c.x_px - x) * (a.y_px - y) - (a.x_px - x) * (c.y_px - y);
  const float wc = (a.x_px - x) * (b.y_px - y) - (b.x_px - x) * (a.y_px - y);
  const float sum = wa + wb + wc;
  if (sum == 0) return {1, 0, 0};
  return {wa / sum, wb / sum, wc / sum};
}

}  // namespace

ProjectCylinderResult project_cylinder(const Mesh& mesh, const MeshPoints& shape, const Axis& axis,
                                       const ProjectCylinderOptions& options) {
  const std::size_t count = shape.points_mm.size();
  check(count > 0 && mesh.points_mm.size() == count, "shape has ", count, " points, the mesh ", mesh.points_mm.size());
  check(mesh.colors_srgb.empty() || mesh.colors_srgb.size() == count, "mesh has ", mesh.colors_srgb.size(),
        " colours for ", count, " points");
  std::vector<CylinderPlace> places;
  double top = -1e9, bottom = 1e9;
  for (const Vec3f& p : shape.points_mm) {
    places.push_back(cylinder_place(axis, p));
    check(std::isfinite(places.back().h_mm) && places.back().radius_mm < static_cast<double>(beyond_mm),
          "shape has a point ", places.size() - 1, " at (", p[0], ", ", p[1], ", ", p[2],
          ") mm, expected one less than ", beyond_mm, " mm from the axis");
    top = std::max(top, places.back().h_mm);
    bottom = std::min(bottom, places.back().h_mm);
  }
  const int columns = static_cast<int>(options.columns);
  const int rows = 1 + static_cast<int>(std::ceil((top - bottom) / options.step_mm));
  check(rows <= 8192, "shape is ", top - bottom, " mm high, which makes ", rows, " rows, expected at most 8192");
  ProjectCylinderResult result;
  CylinderScan& scan = result.scan;
  scan.axis = axis;
  scan.top_mm = static_cast<float>(top);
  scan.step_mm = static_cast<float>(options.step_mm);
  scan.phi_step_rad = static_cast<float>(2 * std::numbers::pi / columns);
  std::vector<render::ScreenPoint> screen;
  for (const CylinderPlace& place : places)
    screen.push_back({static_cast<float>(place.phi_rad / static_cast<double>(scan.phi_step_rad) + 0.5 * (columns - 1)),
                      static_cast<float>((top - place.h_mm) / options.step_mm),
                      static_cast<float>(static_cast<double>(beyond_mm) - place.radius_mm)});
  std::vector<render::Triangle> triangles = render::triangulate(mesh, false).triangles;
  // The back of the head, where the turn ends, would be drawn across the whole picture.
  std::erase_if(triangles, [&](const render::Triangle& t) {
    const auto [low, high] = std::minmax({screen[t[0]].x_px, screen[t[1]].x_px, screen[t[2]].x_px});
    return high - low > 0.5f * static_cast<float>(columns);
  });
  const render::Raster raster =
      render::rasterize(screen, triangles, {.width_px = columns, .height_px = rows, .culling = render::Culling::none});
  scan.picture = {columns, rows, 3, std::vector<std::uint8_t>(raster.triangles.size() * 3, 0)};
  scan.radius_mm.assign(raster.triangles.size(), 0);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const std::size_t i = raster.index(x, y);
      if (raster.triangles[i] < 0) continue;
      const render::Triangle& t = triangles[static_cast<std::size_t>(raster.triangles[i])];
      const Vec3f w =
          weights_at(screen[t[0]], screen[t[1]], screen[t[2]], static_cast<float>(x), static_cast<float>(y));
      Vec3f colour = {0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) {
        scan.radius_mm[i] += w[k] * static_cast<float>(places[t[k]].radius_mm);
        for (std::size_t c = 0; c < 3 && !mesh.colors_srgb.empty(); ++c) colour[c] += w[k] * mesh.colors_srgb[t[k]][c];
      }
      for (std::size_t c = 0; c < 3; ++c)
        scan.picture.pixels[3 * i + c] = static_cast<std::uint8_t>(std::clamp(std::lround(255 * colour[c]), 0l, 255l));
    }
  const auto mark = [&](const char* name, std::uint32_t v) {
    result.marks.points.push_back(
        {name, static_cast<double>(screen[v].x_px), static_cast<double>(screen[v].y_px), true});
  };
  const MouthOpening mouth = find_mouth_opening(mesh);
  double mouth_h = -1e9, mouth_x = 0;
  if (mouth.found()) {
    mark("inner_lip_0", mouth.right_corner);
    mark("inner_lip_4", mouth.left_corner);
    mouth_h = 0.5 * (places[mouth.right_corner].h_mm + places[mouth.left_corner].h_mm);
    mouth_x = 0.5 * static_cast<double>(shape.points_mm[mouth.right_corner][0] + shape.points_mm[mouth.left_corner][0]);
  }
  std::size_t tip = count;
  for (std::size_t v = 0; v < count; ++v) {
    if (mouth.found() && (places[v].h_mm < mouth_h + 12 || places[v].h_mm > mouth_h + 70 ||
                          std::fabs(static_cast<double>(shape.points_mm[v][0]) - mouth_x) > 30))
      continue;
    if (tip == count || places[v].radius_mm > places[tip].radius_mm) tip = v;
  }
  if (tip < count) mark("nose_tip", static_cast<std::uint32_t>(tip));
  return result;
}

}  // namespace face::transfer
