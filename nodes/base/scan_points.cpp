// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/scan_points.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"

namespace face {
namespace {

using Triple = std::array<double, 3>;

Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Unit vectors of an axis: along it, towards phi = 0 (+z as far as the axis allows), towards phi = 90 degrees.
std::array<Triple, 3> frame_of(const Axis& axis) {
  Triple up{};
  for (std::size_t k = 0; k < 3; ++k) up[k] = static_cast<double>(axis.direction[k]);
  const double length = std::sqrt(dot(up, up));
  check(length > 0, "the axis has no direction");
  for (double& x : up) x /= length;
  Triple front = {-up[0] * up[2], -up[1] * up[2], 1 - up[2] * up[2]};
  if (dot(front, front) < 1e-12) front = {0, -1, 0};
  const double front_length = std::sqrt(dot(front, front));
  for (double& x : front) x /= front_length;
  return {up, front, cross(up, front)};
}

Triple from_origin(const Axis& axis, const Vec3f& point_mm) {
  Triple out{};
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<double>(point_mm[k]) - static_cast<double>(axis.origin_mm[k]);
  return out;
}

}  // namespace

void check_scan(const DepthScan& scan, const char* name) {
  const std::size_t count =
      static_cast<std::size_t>(scan.picture.width) * static_cast<std::size_t>(scan.picture.height);
  check(scan.depth_mm.size() == count, name, " has ", scan.depth_mm.size(), " depths, its picture is ",
        scan.picture.width, " x ", scan.picture.height, " pixels");
  check(scan.picture.pixels.size() == count * static_cast<std::size_t>(scan.picture.channels), name, "'s picture has ",
        scan.picture.pixels.size(), " bytes, expected ", scan.picture.width, " x ", scan.picture.height, " x ",
        scan.picture.channels);
  check(scan.camera.focal_px > 0, name, "'s camera has a focal length of ", scan.camera.focal_px,
        " px, expected more than 0");
}

ScanRays::ScanRays(const Camera& camera) : camera_(camera) {}

Vec3f ScanRays::point(double x_px, double y_px, float depth_mm) const {
  const double depth = static_cast<double>(depth_mm), focal = static_cast<double>(camera_.focal_px);
  const Triple in_cam = {(x_px - static_cast<double>(camera_.centre_x_px)) * depth / focal,
                         -(y_px - static_cast<double>(camera_.centre_y_px)) * depth / focal, -depth};
  Vec3f out{};
  for (std::size_t k = 0; k < 3; ++k) {
    double sum = static_cast<double>(camera_.position_mm[k]);
    for (std::size_t r = 0; r < 3; ++r) sum += static_cast<double>(camera_.cam_from_world[r * 3 + k]) * in_cam[r];
    out[k] = static_cast<float>(sum);
  }
  return out;
}

ScanPixel pixel_of(const Camera& camera, const Vec3f& point_mm) {
  Triple in_cam{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t k = 0; k < 3; ++k)
      in_cam[r] += static_cast<double>(camera.cam_from_world[r * 3 + k]) *
                   (static_cast<double>(point_mm[k]) - static_cast<double>(camera.position_mm[k]));
  const double depth = -in_cam[2], scale = depth > 0 ? static_cast<double>(camera.focal_px) / depth : 0;
  return {static_cast<double>(camera.centre_x_px) + scale * in_cam[0],
          static_cast<double>(camera.centre_y_px) - scale * in_cam[1], depth};
}

float depth_at(const DepthScan& scan, double x_px, double y_px) {
  const int width = scan.picture.width, height = scan.picture.height;
  if (!(x_px >= 0 && y_px >= 0 && x_px <= width - 1 && y_px <= height - 1)) return 0;
  const int x0 = std::min(static_cast<int>(x_px), std::max(width - 2, 0)),
            y0 = std::min(static_cast<int>(y_px), std::max(height - 2, 0));
  const double fx = x_px - x0, fy = y_px - y0;
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const int dx = k & 1, dy = k >> 1;
    const double weight = (dx ? fx : 1 - fx) * (dy ? fy : 1 - fy);
    if (weight == 0) continue;
    const float depth = scan.depth_mm[static_cast<std::size_t>((y0 + dy) * width + x0 + dx)];
    if (!(depth > 0)) return 0;
    sum += weight * static_cast<double>(depth);
  }
  return static_cast<float>(sum);
}

Camera moved_camera(const Camera& camera, const RigidMotion& to_from_world) {
  Camera out = camera;
  const auto& turn = to_from_world.rotation;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;  // cam_from_world * turn transposed
      for (std::size_t k = 0; k < 3; ++k)
        sum += static_cast<double>(camera.cam_from_world[r * 3 + k]) * turn[c * 3 + k];
      out.cam_from_world[r * 3 + c] = static_cast<float>(sum);
    }
  for (std::size_t r = 0; r < 3; ++r) {
    double sum = to_from_world.translation_mm[r];
    for (std::size_t k = 0; k < 3; ++k) sum += turn[r * 3 + k] * static_cast<double>(camera.position_mm[k]);
    out.position_mm[r] = static_cast<float>(sum);
  }
  return out;
}

double radius_about(const Axis& axis, const Vec3f& point_mm) {
  const Triple p = from_origin(axis, point_mm);
  Triple up{};
  for (std::size_t k = 0; k < 3; ++k) up[k] = static_cast<double>(axis.direction[k]);
  const Triple across = cross(p, up);
  return std::sqrt(dot(across, across) / dot(up, up));
}

CylinderPlace cylinder_place(const Axis& axis, const Vec3f& point_mm) {
  const auto [up, front, side] = frame_of(axis);
  const Triple p = from_origin(axis, point_mm);
  const double x = dot(p, side), z = dot(p, front);
  return {dot(p, up), std::atan2(x, z), std::hypot(x, z)};
}

Vec3f cylinder_point(const Axis& axis, const CylinderPlace& place) {
  const auto [up, front, side] = frame_of(axis);
  const double x = place.radius_mm * std::sin(place.phi_rad), z = place.radius_mm * std::cos(place.phi_rad);
  Vec3f out{};
  for (std::size_t k = 0; k < 3; ++k)
    out[k] =
        static_cast<float>(static_cast<double>(axis.origin_mm[k]) + place.h_mm * up[k] + x * side[k] + z * front[k]);
  return out;
}

}  // namespace face
