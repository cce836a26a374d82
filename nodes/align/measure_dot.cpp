// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/measure_dot.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace face::align {
namespace {

constexpr double ring_from = 1.6, ring_to = 2.3;  // radii
constexpr double dot_to = 1.6;                    // radii
constexpr int plane_rounds = 5, dot_rounds = 3;
constexpr double first_spread = 10, spread = 6;  // grey levels at which a pixel of the ring counts a quarter
constexpr double rim = 0.15;                     // of the way from skin to dot, which counts nothing: noise is not dot
constexpr double core_px = 0.6;                  // whose mean is the dot's own grey

struct Pixel {
  double dx, dy, level;
};

// level = plane . (1, dx, dy) over most of the pixels.
Eigen::Vector3d plane_of(const std::vector<Pixel>& ring) {
  std::vector<double> levels;
  for (const Pixel& p : ring) levels.push_back(p.level);
  const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
  std::nth_element(levels.begin(), middle, levels.end());
  Eigen::Vector3d plane(*middle, 0, 0);
  for (int round = 0; round < plane_rounds; ++round) {
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const Pixel& p : ring) {
      const Eigen::Vector3d row(1, p.dx, p.dy);
      const double residual = (p.level - plane.dot(row)) / (round == 0 ? first_spread : spread);
      const double weight = 1 / ((1 + residual * residual) * (1 + residual * residual));
      a += weight * row * row.transpose();
      b += weight * p.level * row;
    }
    plane = a.ldlt().solve(b);
  }
  return plane;
}

}  // namespace

Dot measure_dot(const Image& grey, int x, int y, double radius_px) {
  const int reach = static_cast<int>(std::ceil(ring_to * radius_px));
  Dot dot{static_cast<double>(x), static_cast<double>(y), 0, 0};
  for (int round = 0; round < dot_rounds; ++round) {
    const int px = static_cast<int>(std::lround(dot.x_px)), py = static_cast<int>(std::lround(dot.y_px));
    std::vector<Pixel> ring, inner;  // about (px, py)
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        if (px + dx < 0 || py + dy < 0 || px + dx >= grey.width || py + dy >= grey.height) continue;
        const Pixel p{static_cast<double>(dx), static_cast<double>(dy),
                      static_cast<double>(grey.pixels[static_cast<std::size_t>((py + dy) * grey.width + px + dx)])};
        const double far = std::hypot(dx, dy);
        if (far >= ring_from * radius_px && far <= ring_to * radius_px) ring.push_back(p);
        if (std::hypot(px + dx - dot.x_px, py + dy - dot.y_px) <= dot_to * radius_px) inner.push_back(p);
      }
    if (ring.size() < 3) return dot;
    const Eigen::Vector3d plane = plane_of(ring);
    const auto contrast = [&](const Pixel& p) {
      return p.level / std::max(plane.dot(Eigen::Vector3d(1, p.dx, p.dy)), 1.0) - 1;
    };
    double own = 0, core = 0;
    for (const Pixel& p : inner)
      if (std::hypot(px + p.dx - dot.x_px, py + p.dy - dot.y_px) <= core_px) own += contrast(p), ++core;
    if (core == 0 || own == 0) return dot;
    own /= core;
    double area = 0, sx = 0, sy = 0, xx = 0, xy = 0, yy = 0;
    for (const Pixel& p : inner) {
      const double share = std::clamp((contrast(p) / own - rim) / (1 - 2 * rim), 0.0, 1.0);
      area += share;
      sx += share * p.dx, sy += share * p.dy;
      xx += share * p.dx * p.dx, xy += share * p.dx * p.dy, yy += share * p.dy * p.dy;
    }
    if (area <= 0) return dot;
    sx /= area, sy /= area;
    xx = xx / area - sx * sx, xy = xy / area - sx * sy, yy = yy / area - sy * sy;
    const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
    dot = {px + sx, py + sy, std::sqrt(mean + half), std::sqrt(std::max(mean - half, 0.0))};
  }
  return dot;
}

}  // namespace face::align
