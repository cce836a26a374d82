// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/cylinder_grid.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"

namespace face::model {
namespace {

constexpr float far_mm = 1000;  // the rasteriser keeps the larger 1 / depth: depth far / radius keeps the outermost

std::size_t index_of(const CylinderScan& scan, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(scan.picture.width) + static_cast<std::size_t>(x);
}

}  // namespace

void check_cylinder(const CylinderScan& scan, const char* name) {
  const std::size_t count = static_cast<std::size_t>(std::max(scan.picture.width, 0)) *
                            static_cast<std::size_t>(std::max(scan.picture.height, 0));
  check(scan.radius_mm.size() == count, name, " has ", scan.radius_mm.size(), " radii, its picture is ",
        scan.picture.width, " x ", scan.picture.height, " pixels");
  check(scan.picture.channels == 3 && scan.picture.pixels.size() == 3 * count, name, " has a picture of ",
        scan.picture.channels, " channels and ", scan.picture.pixels.size(), " bytes, expected 3 channels and ",
        3 * count, " bytes");
  check(scan.step_mm > 0 && scan.phi_step_rad > 0, name, " has steps of ", scan.step_mm, " mm and ", scan.phi_step_rad,
        " rad, expected more than 0");
}

CylinderPixel cylinder_pixel(const CylinderScan& scan, const Vec3f& point_mm) {
  const CylinderPlace place = cylinder_place(scan.axis, point_mm);
  return {0.5 * (scan.picture.width - 1) + place.phi_rad / static_cast<double>(scan.phi_step_rad),
          (static_cast<double>(scan.top_mm) - place.h_mm) / static_cast<double>(scan.step_mm), place.radius_mm};
}

Vec3f cylinder_world(const CylinderScan& scan, const CylinderPixel& pixel) {
  return cylinder_point(
      scan.axis,
      {static_cast<double>(scan.top_mm) - pixel.y_px * static_cast<double>(scan.step_mm),
       (pixel.x_px - 0.5 * (scan.picture.width - 1)) * static_cast<double>(scan.phi_step_rad), pixel.radius_mm});
}

double cylinder_radius(const CylinderScan& scan, double x_px, double y_px) {
  if (!(x_px >= 0 && y_px >= 0 && x_px <= scan.picture.width - 1 && y_px <= scan.picture.height - 1)) return 0;
  const int x = static_cast<int>(x_px), y = static_cast<int>(y_px);
  const double fx = x_px - x, fy = y_px - y;
  double sum = 0;
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const double share = (dx == 1 ? fx : 1 - fx) * (dy == 1 ? fy : 1 - fy);
      if (share == 0) continue;
      const float radius = scan.radius_mm[index_of(scan, x + dx, y + dy)];
      if (!(radius > 0)) return 0;
      sum += share * static_cast<double>(radius);
    }
  return sum;
}

std::array<double, 3> cylinder_colour(const CylinderScan& scan, double x_px, double y_px) {
  if (std::isnan(x_px) || std::isnan(y_px) || scan.picture.pixels.empty()) return {0, 0, 0};
  x_px = std::clamp(x_px, 0.0, scan.picture.width - 1.0);
  y_px = std::clamp(y_px, 0.0, scan.picture.height - 1.0);
  const int x = static_cast<int>(x_px), y = static_cast<int>(y_px);
  const int x1 = std::min(x + 1, scan.picture.width - 1), y1 = std::min(y + 1, scan.picture.height - 1);
  const double fx = x_px - x, fy = y_px - y;
  const std::uint8_t* p = scan.picture.pixels.data();
  std::array<double, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = (p[3 * index_of(scan, x, y) + c] * (1 - fx) + p[3 * index_of(scan, x1, y) + c] * fx) * (1 - fy) +
                (p[3 * index_of(scan, x, y1) + c] * (1 - fx) + p[3 * index_of(scan, x1, y1) + c] * fx) * fy;
  return colour;
}

CylinderView view_cylinder(const CylinderScan& grid, const std::vector<Vec3f>& points_mm,
                           const std::vector<render::Triangle>& triangles) {
  CylinderView view;
  view.screen.reserve(points_mm.size());
  constexpr double most_px = 1e5;  // a vertex farther up or down is a mistake
  std::vector<bool> nowhere;
  bool any_nowhere = false;
  for (const Vec3f& point : points_mm) {
    const CylinderPixel pixel = cylinder_pixel(grid, point);
    const bool somewhere = std::isfinite(pixel.x_px + pixel.y_px + pixel.radius_mm) && std::abs(pixel.y_px) < most_px;
    if (!somewhere) any_nowhere = true;
    nowhere.push_back(!somewhere);
    view.screen.push_back(somewhere
                              ? render::ScreenPoint{static_cast<float>(pixel.x_px), static_cast<float>(pixel.y_px),
                                                    far_mm / static_cast<float>(std::max(pixel.radius_mm, 1e-3))}
                              : render::ScreenPoint{0, 0, far_mm});
  }
  // A triangle across the seam is drawn as a point: what a raster counts stays the caller's list.
  std::vector<render::Triangle> drawn = triangles;
  const float seam = 0.45f * static_cast<float>(grid.picture.width);
  for (render::Triangle& t : drawn) {
    const auto [least, most] = std::minmax({view.screen[t[0]].x_px, view.screen[t[1]].x_px, view.screen[t[2]].x_px});
    // So is one with a vertex that is nowhere.
    const bool lost = any_nowhere && (nowhere[t[0]] || nowhere[t[1]] || nowhere[t[2]]);
    if (lost || most - least > seam) t = {t[0], t[0], t[0]};
  }
  render::RasterOptions options;
  options.width_px = grid.picture.width;
  options.height_px = grid.picture.height;
  options.near_mm = 0.01f;  // far enough for any radius
  options.culling = render::Culling::none;
  view.raster = render::rasterize(view.screen, drawn, options);
  return view;
}

}  // namespace face::model
