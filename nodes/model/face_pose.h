// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

#include "nodes/types/camera.h"
#include "nodes/types/vec.h"

namespace face::model {

// How a head stands before a camera, in numbers that a picture determines one by one: where its middle is seen, how
// large, how strong the perspective is. The usual position and focal length would be all but interchangeable.
struct FacePose {
  static constexpr int size = 7;                                 // parameters
  std::array<double, 9> rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // cam_from_head, rows
  std::array<double, 3> centre_mm = {0, 0, 0};                   // the point of the head about which it turns
  double u_px = 0, v_px = 0;                                     // where that point is seen
  double log_scale = 0;                                          // ln(focal / depth of that point), px/mm
  double log_focal = 7;                                          // ln of the focal length, px
  double middle_x_px = 0, middle_y_px = 0;                       // where the camera's axis meets the picture

  double depth_mm() const;
};

// A point of the head in the picture. Derivatives by the 7 parameters (turn about the camera's x, y and z in rad, u, v,
// log_scale, log_focal) and by the point in the head's frame.
struct PoseView {
  double x_px = 0, y_px = 0, depth_mm = 0;
  std::array<std::array<double, FacePose::size>, 2> by_pose{};
  std::array<std::array<double, 3>, 2> by_point{};
};

PoseView view(const FacePose& pose, const Vec3f& point_mm);

// The pose after a step of its parameters.
FacePose moved(const FacePose& pose, const std::array<double, FacePose::size>& step);

std::array<double, 3> in_camera(const FacePose& pose, const Vec3f& direction);

Camera camera_of(const FacePose& pose);
FacePose pose_of(const Camera& camera, const Vec3f& centre_mm);

// Largest turn of the head away from the camera, in degrees: angle between the head's z axis and the camera's.
double turn_deg(const FacePose& pose);

// The same pose in a picture of another size; factor = new pixels per old one.
FacePose scaled(const FacePose& pose, double factor);

}  // namespace face::model
