// SPDX-License-Identifier: Apache-2.0
// A small world with truth for the model's and the texture's tests: the embedded head's model, persons off it, pictures
// of them.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/random.h"
#include "nodes/model/face_pose.h"
#include "nodes/model/from_rig.h"
#include "nodes/model/pose_model.h"
#include "nodes/phantom/identity_modes.h"
#include "nodes/phantom/make_head.h"
#include "nodes/phantom/video_frame.h"
#include "nodes/render/camera.h"
#include "nodes/types/landmarks.h"

namespace test {

inline const face::Rig& head() {
  static const face::Rig rig = face::phantom::make_head({.with_hair = false});
  return rig;
}

inline const face::MorphableModel& head_model() {
  static const face::MorphableModel model = [] {
    const face::ShapeSet modes = face::phantom::identity_modes({.with_hair = false});
    return face::model::from_rig(head(), &modes, {.samples = 200, .skins = 40});
  }();
  return model;
}

// The model's head upright in the middle of a picture of 240 x 240 pixels.
inline face::model::FacePose pose_in_front() {
  face::model::FacePose pose;
  const face::Vec3f centre = face::model::turning_point(head_model());
  for (std::size_t k = 0; k < 3; ++k) pose.centre_mm[k] = centre[k];
  pose.u_px = pose.v_px = 120;
  pose.middle_x_px = pose.middle_y_px = 119.5;
  pose.log_scale = std::log(1.1);
  pose.log_focal = std::log(600);
  return pose;
}

// A scene: the head turned by yaw before a camera that stands on the z axis.
struct Scene {
  face::RigidMotion world_from_head;
  face::Camera camera;
  face::Lighting lighting;
};

inline Scene make_scene(double yaw_deg, int width_px = 480, int height_px = 480) {
  Scene scene;
  const double yaw = yaw_deg * std::numbers::pi / 180;
  scene.world_from_head.rotation = {std::cos(yaw), 0, std::sin(yaw), 0, 1, 0, -std::sin(yaw), 0, std::cos(yaw)};
  scene.camera.position_mm = {0, 10, 800};
  scene.camera.centre_x_px = 0.5f * static_cast<float>(width_px - 1);
  scene.camera.centre_y_px = 0.5f * static_cast<float>(height_px - 1);
  scene.camera.focal_px = 1.7f * 800 * static_cast<float>(height_px) / 480.0f;
  scene.lighting.ambient = {0.4f, 0.4f, 0.4f};
  scene.lighting.parallel = {0.6f, 0.58f, 0.55f};
  scene.lighting.towards_light = {0.4f, 0.4f, 0.8246f};
  return scene;
}

inline std::vector<face::Vec3f> in_world(const Scene& scene, std::vector<face::Vec3f> points) {
  const auto& r = scene.world_from_head.rotation;
  for (face::Vec3f& p : points) {
    const face::Vec3f q = p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = static_cast<float>(r[3 * k] * q[0] + r[3 * k + 1] * q[1] + r[3 * k + 2] * q[2] +
                                scene.world_from_head.translation_mm[k]);
  }
  return points;
}

// Named points of posed vertices, with noise.
inline face::Landmarks points_of(const Scene& scene, const std::vector<face::Vec3f>& posed_mm, double noise_px,
                                 std::uint64_t seed = 1) {
  static const std::vector<std::pair<std::string, std::size_t>> names = {
      {"eye_outer_r", 36},  {"eye_inner_r", 39},    {"eye_inner_l", 42},  {"eye_outer_l", 45},
      {"nose_tip", 30},     {"nose_wing_r", 31},    {"nose_wing_l", 35},  {"mouth_corner_r", 48},
      {"chin", 8},          {"mouth_corner_l", 54}, {"upper_lip", 51},    {"lower_lip", 57},
      {"brow_outer_r", 17}, {"brow_outer_l", 26},   {"brow_inner_r", 21}, {"brow_inner_l", 22}};
  face::Random random(seed);
  face::Landmarks landmarks;
  const std::vector<face::Vec3f> world = in_world(scene, posed_mm);
  for (const auto& [name, point] : names) {
    const face::render::ScreenPoint seen = face::render::project(scene.camera, world[head().landmarks68[point]]);
    landmarks.points.push_back(
        {name, seen.x_px + noise_px * random.normal(), seen.y_px + noise_px * random.normal(), true});
  }
  return landmarks;
}

inline face::Image blank(int width, int height, std::uint8_t value = 128) {
  face::Image image;
  image.width = width;
  image.height = height;
  image.channels = 3;
  image.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, value);
  return image;
}

// Angle between a fit's and a scene's orientation of the head, in degrees.
inline double turn_error_deg(const face::Camera& camera, const Scene& scene) {
  double trace = 0;
  for (std::size_t i = 0; i < 9; ++i)
    trace += static_cast<double>(camera.cam_from_world[i]) * scene.world_from_head.rotation[i];
  return std::acos(std::clamp(0.5 * (trace - 1), -1.0, 1.0)) * 180 / std::numbers::pi;
}

}  // namespace test
