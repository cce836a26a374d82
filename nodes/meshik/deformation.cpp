// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/deformation.h"

#include <Eigen/Dense>
#include <cmath>

#include "nodes/base/check.h"

namespace face::meshik {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d vector(const Vec3d& v) { return {v[0], v[1], v[2]}; }

Mat3d values(const Matrix3d& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

// Edges and normal as columns.
Matrix3d frame(const std::array<Vec3d, 3>& triangle) {
  const Vector3d e1 = vector(triangle[1]) - vector(triangle[0]), e2 = vector(triangle[2]) - vector(triangle[0]);
  const Vector3d n = e1.cross(e2);
  const double length = n.norm();
  Matrix3d m;
  m << e1, e2, (length > 0 ? Vector3d(n / std::sqrt(length)) : Vector3d::Zero());
  return m;
}

Matrix3d cross_matrix(const Vector3d& w) {
  Matrix3d m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

}  // namespace

Mat3d deformation_gradient(const std::array<Vec3d, 3>& from, const std::array<Vec3d, 3>& to) {
  const Matrix3d base = frame(from);
  check(base.determinant() > 0, "a triangle of the reference has no area");
  return values(frame(to) * base.inverse());
}

PolarParts polar_parts(const Mat3d& gradient) {
  const Matrix3d f = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(gradient.data());
  const Eigen::JacobiSVD<Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d u = svd.matrixU();
  Vector3d s = svd.singularValues();
  if ((u * svd.matrixV().transpose()).determinant() < 0) {
    u.col(2) *= -1;
    s(2) *= -1;
  }
  const Eigen::AngleAxisd turn(Matrix3d(u * svd.matrixV().transpose()));
  const Vector3d w = turn.angle() * turn.axis();
  return {{w.x(), w.y(), w.z()}, values(svd.matrixV() * s.asDiagonal() * svd.matrixV().transpose())};
}

Mat3d rotation_matrix(const Vec3d& rotation) {
  const Vector3d w = vector(rotation);
  const double angle = w.norm();
  const Matrix3d x = cross_matrix(w);
  // 1 - cos = 2 sin^2 of the half: no cancellation.
  const double a = angle > 0 ? std::sin(angle) / angle : 1;
  const double half = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
  return values(Matrix3d::Identity() + a * x + 2 * half * half * x * x);
}

Mat3d left_jacobian(const Vec3d& rotation) {
  const Vector3d w = vector(rotation);
  const double angle = w.norm(), x2 = angle * angle;
  const Matrix3d x = cross_matrix(w);
  const double half = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
  // (angle - sin angle) / angle^3, by its series where the difference cancels.
  const double c = angle > 0.1 ? (angle - std::sin(angle)) / (x2 * angle)
                               : 1.0 / 6 * (1 - x2 / 20 * (1 - x2 / 42 * (1 - x2 / 72 * (1 - x2 / 110))));
  return values(Matrix3d::Identity() + 2 * half * half * x + c * x * x);
}

}  // namespace face::meshik
