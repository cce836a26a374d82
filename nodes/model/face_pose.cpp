// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/face_pose.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace face::model {
namespace {

using Rows3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Map<const Rows3> rotation_of(const FacePose& pose) { return Eigen::Map<const Rows3>(pose.rotation.data()); }

// Of the middle, in the camera's frame.
Eigen::Vector3d translation_of(const FacePose& pose) {
  const double mm_per_px = std::exp(-pose.log_scale);
  return {(pose.u_px - pose.middle_x_px) * mm_per_px, -(pose.v_px - pose.middle_y_px) * mm_per_px,
          -std::exp(pose.log_focal) * mm_per_px};
}

}  // namespace

double FacePose::depth_mm() const { return std::exp(log_focal - log_scale); }

PoseView view(const FacePose& pose, const Vec3f& point_mm) {
  const auto r = rotation_of(pose);
  const Eigen::Vector3d arm = r * Eigen::Vector3d(point_mm[0] - pose.centre_mm[0], point_mm[1] - pose.centre_mm[1],
                                                  point_mm[2] - pose.centre_mm[2]);
  const Eigen::Vector3d t = translation_of(pose);
  const Eigen::Vector3d p = arm + t;
  const double f = std::exp(pose.log_focal), mm_per_px = std::exp(-pose.log_scale);
  PoseView result;
  const double depth = -p.z();
  result.depth_mm = depth;
  const double scale = f / depth;
  result.x_px = pose.middle_x_px + scale * p.x();
  result.y_px = pose.middle_y_px - scale * p.y();
  const Eigen::Vector3d dx(scale, 0, scale * p.x() / depth), dy(0, -scale, -scale * p.y() / depth);
  for (int row = 0; row < 2; ++row) {
    const Eigen::Vector3d& d = row == 0 ? dx : dy;
    auto& by_pose = result.by_pose[static_cast<std::size_t>(row)];
    const Eigen::Vector3d turn = arm.cross(d);  // d . (w x arm) = w . (arm x d)
    by_pose = {turn.x(), turn.y(), turn.z(), d.x() * mm_per_px, -d.y() * mm_per_px, -d.dot(t), d.z() * t.z()};
    by_pose[6] += row == 0 ? result.x_px - pose.middle_x_px : result.y_px - pose.middle_y_px;
    const Eigen::Vector3d by_point = r.transpose() * d;
    result.by_point[static_cast<std::size_t>(row)] = {by_point.x(), by_point.y(), by_point.z()};
  }
  return result;
}

FacePose moved(const FacePose& pose, const std::array<double, FacePose::size>& step) {
  FacePose result = pose;
  const Eigen::Vector3d turn(step[0], step[1], step[2]);
  const double angle = turn.norm();
  Rows3 r = rotation_of(pose);
  if (angle > 0) r = (Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * r).eval();
  Eigen::Map<Rows3>(result.rotation.data()) = Eigen::Quaterniond(Eigen::Matrix3d(r)).normalized().toRotationMatrix();
  result.u_px += step[3];
  result.v_px += step[4];
  result.log_scale += step[5];
  result.log_focal += step[6];
  return result;
}

std::array<double, 3> in_camera(const FacePose& pose, const Vec3f& direction) {
  const Eigen::Vector3d d = rotation_of(pose) * Eigen::Vector3d(direction[0], direction[1], direction[2]);
  return {d.x(), d.y(), d.z()};
}

Camera camera_of(const FacePose& pose) {
  Camera camera;
  for (std::size_t i = 0; i < 9; ++i) camera.cam_from_world[i] = static_cast<float>(pose.rotation[i]);
  const Eigen::Vector3d position = Eigen::Vector3d(pose.centre_mm[0], pose.centre_mm[1], pose.centre_mm[2]) -
                                   rotation_of(pose).transpose() * translation_of(pose);
  for (int k = 0; k < 3; ++k) camera.position_mm[static_cast<std::size_t>(k)] = static_cast<float>(position[k]);
  camera.focal_px = static_cast<float>(std::exp(pose.log_focal));
  camera.centre_x_px = static_cast<float>(pose.middle_x_px);
  camera.centre_y_px = static_cast<float>(pose.middle_y_px);
  return camera;
}

FacePose pose_of(const Camera& camera, const Vec3f& centre_mm) {
  FacePose pose;
  Rows3 r;
  for (int i = 0; i < 9; ++i) r(i / 3, i % 3) = camera.cam_from_world[static_cast<std::size_t>(i)];
  Eigen::Map<Rows3>(pose.rotation.data()) = Eigen::Quaterniond(Eigen::Matrix3d(r)).normalized().toRotationMatrix();
  Eigen::Vector3d arm;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    pose.centre_mm[axis] = centre_mm[axis];
    arm[k] = static_cast<double>(centre_mm[axis]) - camera.position_mm[axis];
  }
  const Eigen::Vector3d p = rotation_of(pose) * arm;
  pose.middle_x_px = camera.centre_x_px;
  pose.middle_y_px = camera.centre_y_px;
  const double scale = camera.focal_px / -p.z();
  pose.u_px = pose.middle_x_px + scale * p.x();
  pose.v_px = pose.middle_y_px - scale * p.y();
  pose.log_scale = std::log(scale);
  pose.log_focal = std::log(camera.focal_px);
  return pose;
}

double turn_deg(const FacePose& pose) {
  return std::acos(std::clamp(pose.rotation[8], -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

FacePose scaled(const FacePose& pose, double factor) {
  FacePose result = pose;
  result.u_px = (pose.u_px + 0.5) * factor - 0.5;
  result.v_px = (pose.v_px + 0.5) * factor - 0.5;
  result.middle_x_px = (pose.middle_x_px + 0.5) * factor - 0.5;
  result.middle_y_px = (pose.middle_y_px + 0.5) * factor - 0.5;
  result.log_scale += std::log(factor);
  result.log_focal += std::log(factor);
  return result;
}

}  // namespace face::model
