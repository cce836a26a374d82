// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <optional>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/vec.h"

namespace face::transfer {

// Throws where radius and picture differ in size or steps are not positive. `name` is what the message calls the scan.
void check_cylinder(const CylinderScan& scan, const char* name);

// What a scan around an axis has at a height and an angle, bilinear between its pixels; none where one of the four is
// not measured.
struct CylinderSurface {
  Vec3f point_mm = {0, 0, 0};
  Vec3f normal = {0, 0, 1};  // unit, outwards
  double radius_mm = 0;
  Vec3f color_srgb = {0, 0, 0};
};
std::optional<CylinderSurface> surface_at(const CylinderScan& scan, double h_mm, double phi_rad);

// Height and angle of a place in its picture.
std::array<double, 2> place_at(const CylinderScan& scan, double x_px, double y_px);

}  // namespace face::transfer
