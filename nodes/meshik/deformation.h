// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

namespace face::meshik {

using Vec3d = std::array<double, 3>;
using Mat3d = std::array<double, 9>;  // row by row

// The linear part of the affine map that takes one triangle and its normal to another (Sumner and Popovic, Deformation
// Transfer for Triangle Meshes, SIGGRAPH 2004, eqs. 3 and 4; fourth vertex at normal / sqrt(length of the cross
// product), so that it scales with the triangle). from: a triangle whose area is not 0.
Mat3d deformation_gradient(const std::array<Vec3d, 3>& from, const std::array<Vec3d, 3>& to);

// F = R S with R a rotation and S symmetric (Shoemake and Duff, Matrix Animation and Polar Decomposition, Graphics
// Interface 1992), by singular values; where F mirrors, S has the negative one. The rotation comes as its vector: axis
// x angle, angle in [0, pi].
struct PolarParts {
  Vec3d rotation = {0, 0, 0};
  Mat3d stretch = {1, 0, 0, 0, 1, 0, 0, 0, 1};
};
PolarParts polar_parts(const Mat3d& gradient);

// R = exp[w]x (Rodrigues).
Mat3d rotation_matrix(const Vec3d& rotation);

// d exp[w]x = [J dw]x exp[w]x: the left Jacobian of the rotation group (Barfoot, State Estimation for Robotics, 2017,
// eq. 7.77). dw itself in place of J dw is right for parallel w and dw alone.
Mat3d left_jacobian(const Vec3d& rotation);

}  // namespace face::meshik
