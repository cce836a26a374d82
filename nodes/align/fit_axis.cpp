// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/fit_axis.h"

#include <Eigen/Dense>
#include <cmath>

#include "nodes/base/scan_points.h"

namespace face::align {

FitAxisResult fit_axis(const DepthScan& reference, const FitAxisOptions& options) {
  check_scan(reference, "reference");
  const ScanRays rays(reference.camera);
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int y = 0; y < reference.picture.height; y += 4)
    for (int x = 0; x < reference.picture.width; x += 4) {
      const float depth = reference.depth_mm[static_cast<std::size_t>(y * reference.picture.width + x)];
      if (!(depth > 0)) continue;
      const Vec3f p = rays.point(x, y, depth);
      points.push_back(
          Eigen::Vector3d(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])));
      mean += points.back();
    }
  FitAxisResult result;
  if (points.size() < 10) return result;
  mean /= static_cast<double>(points.size());
  // Unknowns: x and z of the axis at the mean height, its slopes along x and z, the radius. The camera stands towards
  // +z of the world of an aligned scan; the axis lies behind the surface.
  Eigen::Matrix<double, 5, 1> q;
  q << mean(0), mean(2) - 60, 0, 0, 70;
  double square = 0, total = 0;
  for (int round = 0; round < 60; ++round) {
    Eigen::Matrix<double, 5, 5> a = Eigen::Matrix<double, 5, 5>::Zero();
    Eigen::Matrix<double, 5, 1> b = Eigen::Matrix<double, 5, 1>::Zero();
    square = total = 0;
    for (const Eigen::Vector3d& p : points) {
      const double h = p(1) - mean(1), dx = p(0) - q(0) - q(2) * h, dz = p(2) - q(1) - q(3) * h;
      const double r = std::max(std::hypot(dx, dz), 1e-6), e = r - q(4), s = e / 15,
                   w = 1 / ((1 + s * s) * (1 + s * s));
      Eigen::Matrix<double, 5, 1> row;
      row << -dx / r, -dz / r, -dx / r * h, -dz / r * h, -1;
      a += w * row * row.transpose();
      b += w * e * row;
      square += w * e * e;
      total += w;
    }
    const double pull = options.tilt_stiffness * total;
    a(2, 2) += pull, a(3, 3) += pull;
    b(2) += pull * q(2), b(3) += pull * q(3);
    a(1, 1) += 1e-3 * total;  // a flat patch does not say how far behind it the axis is
    a(4, 4) += 1e-3 * total;
    const Eigen::Matrix<double, 5, 1> step = a.ldlt().solve(b);
    q -= step;
    if (step.norm() < 1e-6) break;
  }
  const double length = std::sqrt(1 + q(2) * q(2) + q(3) * q(3));
  result.axis.direction = {static_cast<float>(q(2) / length), static_cast<float>(1 / length),
                           static_cast<float>(q(3) / length)};
  result.axis.origin_mm = {static_cast<float>(q(0)), static_cast<float>(mean(1)), static_cast<float>(q(1))};
  result.mean_radius_mm = q(4);
  result.rms_mm = std::sqrt(square / total);
  return result;
}

}  // namespace face::align
