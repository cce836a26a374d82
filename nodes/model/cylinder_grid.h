// SPDX-License-Identifier: Apache-2.0
// Places of a scan around an axis: pixels, points in the world, and what is measured between pixels.
#pragma once
#include <array>
#include <vector>

#include "nodes/render/rasterize.h"
#include "nodes/types/cylinder_scan.h"

namespace face::model {

// Throws where radii, picture and steps do not make a scan. `name` is what the message calls it.
void check_cylinder(const CylinderScan& scan, const char* name);

// Where a point is in the scan's picture. x_px runs over one full turn about its middle.
struct CylinderPixel {
  double x_px = 0;
  double y_px = 0;
  double radius_mm = 0;
};
CylinderPixel cylinder_pixel(const CylinderScan& scan, const Vec3f& point_mm);
Vec3f cylinder_world(const CylinderScan& scan, const CylinderPixel& pixel);

// The radius between pixels, bilinear; 0 where one of the pixels it is made of is not measured or the place is outside.
double cylinder_radius(const CylinderScan& scan, double x_px, double y_px);
// The colour between pixels, bilinear, 0 to 255; the nearest pixel's outside.
std::array<double, 3> cylinder_colour(const CylinderScan& scan, double x_px, double y_px);

// Which triangle the scanner sees at every pixel, the outermost, and the vertices in its picture (depth 1000 / radius).
// Triangles across the seam at the back are left out.
struct CylinderView {
  std::vector<render::ScreenPoint> screen;
  render::Raster raster;
};
CylinderView view_cylinder(const CylinderScan& grid, const std::vector<Vec3f>& points_mm,
                           const std::vector<render::Triangle>& triangles);

}  // namespace face::model
