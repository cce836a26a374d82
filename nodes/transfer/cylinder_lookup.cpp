// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/cylinder_lookup.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"

namespace face::transfer {

void check_cylinder(const CylinderScan& scan, const char* name) {
  const std::size_t count =
      static_cast<std::size_t>(scan.picture.width) * static_cast<std::size_t>(scan.picture.height);
  check(scan.radius_mm.size() == count && count > 0, name, " has ", scan.radius_mm.size(), " radii, its picture is ",
        scan.picture.width, " x ", scan.picture.height, " pixels");
  check(scan.picture.pixels.size() == count * static_cast<std::size_t>(scan.picture.channels), name, "'s picture has ",
        scan.picture.pixels.size(), " bytes, expected ", scan.picture.width, " x ", scan.picture.height, " x ",
        scan.picture.channels);
  check(scan.step_mm > 0 && scan.phi_step_rad > 0, name, " has steps of ", scan.step_mm, " mm and ", scan.phi_step_rad,
        " rad, expected more than 0");
}

std::array<double, 2> place_at(const CylinderScan& scan, double x_px, double y_px) {
  return {static_cast<double>(scan.top_mm) - y_px * static_cast<double>(scan.step_mm),
          (x_px - 0.5 * (scan.picture.width - 1)) * static_cast<double>(scan.phi_step_rad)};
}

std::optional<CylinderSurface> surface_at(const CylinderScan& scan, double h_mm, double phi_rad) {
  const int width = scan.picture.width, height = scan.picture.height;
  const double turn = 2 * std::numbers::pi / static_cast<double>(scan.phi_step_rad);
  double x = phi_rad / static_cast<double>(scan.phi_step_rad) + 0.5 * (width - 1);
  x -= turn * std::floor(x / turn);
  const double y = (static_cast<double>(scan.top_mm) - h_mm) / static_cast<double>(scan.step_mm);
  if (!(y >= 0) || !(y <= height - 1)) return {};
  const bool closed = std::lround(turn) == width;  // column 0 follows the last
  if (!closed && x > width - 1) return {};
  const int x0 = std::min(static_cast<int>(x), width - 1), y0 = std::min(static_cast<int>(y), std::max(height - 2, 0));
  const int x1 = x0 + 1 < width ? x0 + 1 : (closed ? 0 : x0), y1 = std::min(y0 + 1, height - 1);
  const double fx = x - x0, fy = y - y0;
  const int xs[] = {x0, x1, x0, x1}, ys[] = {y0, y0, y1, y1};
  const double weights[] = {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
  double radius[4];
  CylinderSurface out;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto i = static_cast<std::size_t>(ys[k]) * static_cast<std::size_t>(width) + static_cast<std::size_t>(xs[k]);
    radius[k] = static_cast<double>(scan.radius_mm[i]);
    if (!(radius[k] > 0)) return {};
    out.radius_mm += weights[k] * radius[k];
    const std::uint8_t* p = scan.picture.pixels.data() + i * static_cast<std::size_t>(scan.picture.channels);
    for (std::size_t c = 0; c < 3; ++c)
      out.color_srgb[c] += static_cast<float>(weights[k] * (scan.picture.channels >= 3 ? p[c] : p[0]) / 255);
  }
  // dP/dh = (R_h, 1, 0) and dP/dphi = (R_phi, 0, R) in (outwards, along, around): their product is outwards.
  const double slope_h =
      -((radius[2] - radius[0]) * (1 - fx) + (radius[3] - radius[1]) * fx) / static_cast<double>(scan.step_mm);
  const double slope_phi =
      ((radius[1] - radius[0]) * (1 - fy) + (radius[3] - radius[2]) * fy) / static_cast<double>(scan.phi_step_rad);
  const auto in_frame = [&](double r, double h, double phi) {
    return cylinder_point(scan.axis, {.h_mm = h, .phi_rad = phi, .radius_mm = r});
  };
  const Vec3f origin = in_frame(0, 0, 0), out_by = in_frame(1, 0, phi_rad), along_by = in_frame(0, 1, phi_rad),
              around_by = in_frame(1, 0, phi_rad + std::numbers::pi / 2);
  const double n[] = {1, -slope_h, -slope_phi / out.radius_mm};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (std::size_t k = 0; k < 3; ++k)
    out.normal[k] = static_cast<float>((n[0] * static_cast<double>(out_by[k] - origin[k]) +
                                        n[1] * static_cast<double>(along_by[k] - origin[k]) +
                                        n[2] * static_cast<double>(around_by[k] - origin[k])) /
                                       length);
  out.point_mm = in_frame(out.radius_mm, h_mm, phi_rad);
  return out;
}

}  // namespace face::transfer
