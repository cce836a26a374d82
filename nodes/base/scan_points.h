// SPDX-License-Identifier: Apache-2.0
// Points of a depth scan in its world, and where points are in its picture. One place for the pinhole's signs.
#pragma once
#include <array>

#include "nodes/types/cylinder_scan.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/rigid_motion.h"

namespace face {

// Throws where depth and picture differ in size, or the camera has no focal length. `name` is what the message calls
// it.
void check_scan(const DepthScan& scan, const char* name);

// The rays of a camera: points at a depth along its axis, in the world.
class ScanRays {
 public:
  explicit ScanRays(const Camera& camera);
  Vec3f point(double x_px, double y_px, float depth_mm) const;

 private:
  Camera camera_;
};

// A point of the world in the camera's picture, and its depth along the axis (<= 0 behind the camera).
struct ScanPixel {
  double x_px = 0;
  double y_px = 0;
  double depth_mm = 0;
};
ScanPixel pixel_of(const Camera& camera, const Vec3f& point_mm);

// The depth between pixels, bilinear; 0 where one of the pixels it is made of is not measured or the place is outside.
float depth_at(const DepthScan& scan, double x_px, double y_px);

// The camera seen from a moved world: `to_from_world` carries the old world's points into the new one. Depth and
// picture of a scan stay what they are.
Camera moved_camera(const Camera& camera, const RigidMotion& to_from_world);

// Distance of a point to an axis.
double radius_about(const Axis& axis, const Vec3f& point_mm);

// Place of a point about an axis: h along it from its origin, radius, and the angle phi as in CylinderScan.
struct CylinderPlace {
  double h_mm = 0;
  double phi_rad = 0;
  double radius_mm = 0;
};
CylinderPlace cylinder_place(const Axis& axis, const Vec3f& point_mm);
Vec3f cylinder_point(const Axis& axis, const CylinderPlace& place);

}  // namespace face
