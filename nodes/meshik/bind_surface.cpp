// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/bind_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "nodes/base/check.h"
#include "nodes/base/eigen_vector.h"
#include "nodes/meshik/connected_parts.h"

namespace face::meshik {
namespace {

using Eigen::Vector3d;

// Shares of the corners a, b, c in the point of the triangle that is closest to p.
std::array<double, 3> closest(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  const double sum = va + vb + vc;
  return {1 - vb / sum - vc / sum, vb / sum, vc / sum};
}

struct Facet {
  std::uint32_t first = 0;  // of its three places in the list of corners
  Vector3d a, b, c, middle;
  double radius = 0;
};

}  // namespace

Matrix bind_surface(const std::vector<Vec3f>& points_mm, const std::vector<std::uint32_t>& triangles,
                    const std::vector<std::uint32_t>& coarse) {
  for (const std::uint32_t v : coarse)
    check(v < points_mm.size(), "a coarse triangle has vertex ", v, ", expected one below ", points_mm.size());
  const std::vector<std::uint32_t> part = connected_parts(points_mm.size(), triangles);
  std::vector<std::vector<Facet>> of_part(points_mm.size());
  std::vector<bool> is_coarse(points_mm.size(), false);
  for (std::uint32_t t = 0; t + 2 < coarse.size(); t += 3) {
    Facet f;
    f.first = t;
    f.a = vector_of(points_mm[coarse[t]]), f.b = vector_of(points_mm[coarse[t + 1]]),
    f.c = vector_of(points_mm[coarse[t + 2]]);
    f.middle = (f.a + f.b + f.c) / 3;
    f.radius = std::max({(f.a - f.middle).norm(), (f.b - f.middle).norm(), (f.c - f.middle).norm()});
    of_part[part[coarse[t]]].push_back(f);
    for (std::size_t c = 0; c < 3; ++c) is_coarse[coarse[t + c]] = true;
  }
  Matrix binding{points_mm.size(), 6, std::vector<double>(6 * points_mm.size(), 0.0)};
  for (std::size_t v = 0; v < points_mm.size(); ++v) {
    if (is_coarse[v]) {
      for (std::size_t c = 0; c < 3; ++c) binding.at(v, c) = static_cast<double>(v);
      binding.at(v, 3) = 1;
      continue;
    }
    const Vector3d p = vector_of(points_mm[v]);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Facet& f : of_part[part[v]]) {
      if ((p - f.middle).norm() - f.radius > nearest) continue;
      const std::array<double, 3> share = closest(p, f.a, f.b, f.c);
      const double distance = (p - share[0] * f.a - share[1] * f.b - share[2] * f.c).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      for (std::size_t c = 0; c < 3; ++c)
        binding.at(v, c) = static_cast<double>(coarse[f.first + c]), binding.at(v, 3 + c) = share[c];
    }
    if (nearest == std::numeric_limits<double>::infinity() && !coarse.empty())
      for (std::size_t c = 0; c < 3; ++c) binding.at(v, c) = static_cast<double>(coarse[0]);
  }
  return binding;
}

}  // namespace face::meshik
