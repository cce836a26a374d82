// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/camera.h"

#include <cmath>
#include <numbers>

#include "nodes/base/check.h"

namespace face::render {

Camera orbit_camera(const Vec3f& target_mm, float distance_mm, float yaw_deg, float pitch_deg, float field_of_view_deg,
                    int width_px, int height_px) {
  check(distance_mm > 0, "the camera's distance is ", distance_mm, " mm, expected more than 0");
  check(field_of_view_deg > 0 && field_of_view_deg < 180, "the field of view is ", field_of_view_deg,
        " degrees, expected between 0 and 180");
  const double radians = std::numbers::pi / 180.0;
  const double cos_yaw = std::cos(yaw_deg * radians), sin_yaw = std::sin(yaw_deg * radians);
  const double cos_pitch = std::cos(pitch_deg * radians), sin_pitch = std::sin(pitch_deg * radians);
  const std::array<double, 9> rotation = {cos_yaw,
                                          0,
                                          -sin_yaw,
                                          -sin_yaw * sin_pitch,
                                          cos_pitch,
                                          -cos_yaw * sin_pitch,
                                          sin_yaw * cos_pitch,
                                          sin_pitch,
                                          cos_yaw * cos_pitch};
  Camera camera;
  for (std::size_t i = 0; i < 9; ++i) camera.cam_from_world[i] = static_cast<float>(rotation[i]);
  for (std::size_t axis = 0; axis < 3; ++axis)
    camera.position_mm[axis] = target_mm[axis] + distance_mm * static_cast<float>(rotation[6 + axis]);
  camera.focal_px = static_cast<float>(0.5 * height_px / std::tan(0.5 * field_of_view_deg * radians));
  camera.centre_x_px = 0.5f * static_cast<float>(width_px - 1);
  camera.centre_y_px = 0.5f * static_cast<float>(height_px - 1);
  return camera;
}

Camera supersampled(const Camera& camera, int factor) {
  Camera result = camera;
  const auto scale = static_cast<float>(factor);
  result.focal_px *= scale;
  result.centre_x_px = (camera.centre_x_px + 0.5f) * scale - 0.5f;
  result.centre_y_px = (camera.centre_y_px + 0.5f) * scale - 0.5f;
  return result;
}

ScreenPoint project(const Camera& camera, const Vec3f& point_mm) {
  const std::array<float, 9>& r = camera.cam_from_world;
  const float dx = point_mm[0] - camera.position_mm[0];
  const float dy = point_mm[1] - camera.position_mm[1];
  const float dz = point_mm[2] - camera.position_mm[2];
  const float x = r[0] * dx + r[1] * dy + r[2] * dz;
  const float y = r[3] * dx + r[4] * dy + r[5] * dz;
  const float depth = -(r[6] * dx + r[7] * dy + r[8] * dz);
  const float scale = camera.focal_px / depth;
  return {camera.centre_x_px + scale * x, camera.centre_y_px - scale * y, depth};
}

std::vector<ScreenPoint> project(const Camera& camera, const std::vector<Vec3f>& points_mm) {
  std::vector<ScreenPoint> result(points_mm.size());
  for (std::size_t i = 0; i < points_mm.size(); ++i) result[i] = project(camera, points_mm[i]);
  return result;
}

}  // namespace face::render
