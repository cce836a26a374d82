// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/even_light.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/luma.h"
#include "nodes/base/normal_harmonics.h"
#include "nodes/base/quantile.h"
#include "nodes/base/scan_points.h"
#include "nodes/base/srgb.h"

namespace face::mask {
namespace {

constexpr int reach_px = 2;  // the polynomials that smooth a row leave steps between rows
constexpr std::size_t fewest_normals = 100;
constexpr int rounds = 12;

constexpr int terms = normal_harmonics_count;
using Harmonics = Eigen::Matrix<double, terms, 1>;
struct Lit {
  std::size_t pixel;
  Harmonics normal;
  double light;
};

Eigen::Vector3d point_of(const DepthScan& scan, int x, int y, float depth_mm) {
  const double depth = static_cast<double>(depth_mm), per_px = depth / static_cast<double>(scan.camera.focal_px);
  return {(x - static_cast<double>(scan.camera.centre_x_px)) * per_px,
          -(y - static_cast<double>(scan.camera.centre_y_px)) * per_px, -depth};
}

Harmonics harmonics_of(const Eigen::Vector3d& normal) {
  return Harmonics(normal_harmonics(normal[0], normal[1], normal[2]).data());
}

// Every pixel that has a normal: of measured pixels to either side, or of itself and one side.
std::vector<Lit> lit_pixels(const DepthScan& scan) {
  const int width = scan.picture.width, height = scan.picture.height;
  const auto depth = [&](int x, int y) {
    return x < 0 || y < 0 || x >= width || y >= height
               ? 0.0f
               : scan.depth_mm[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x)];
  };
  const auto along = [&](int x, int y, int dx, int dy, Eigen::Vector3d& way) {
    int before = reach_px, after = reach_px;
    while (before > 0 && !(depth(x - before * dx, y - before * dy) > 0)) --before;
    while (after > 0 && !(depth(x + after * dx, y + after * dy) > 0)) --after;
    if (before + after == 0) return false;
    const int ax = x - before * dx, ay = y - before * dy, bx = x + after * dx, by = y + after * dy;
    way = point_of(scan, bx, by, depth(bx, by)) - point_of(scan, ax, ay, depth(ax, ay));
    return true;
  };
  std::vector<Lit> lit;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (!(depth(x, y) > 0)) continue;
      Eigen::Vector3d right, down;
      if (!along(x, y, 1, 0, right) || !along(x, y, 0, 1, down)) continue;
      const Eigen::Vector3d normal = down.cross(right).normalized();
      if (!normal.allFinite()) continue;
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const std::uint8_t* p = scan.picture.pixels.data() + i * static_cast<std::size_t>(scan.picture.channels);
      lit.push_back({i, harmonics_of(normal), linear_of(grey_value<double>(p, scan.picture.channels) / 255)});
    }
  return lit;
}

}  // namespace

DepthScan even_light(const DepthScan& scan, const EvenLightOptions& options) {
  check_scan(scan, "scan");
  DepthScan result = scan;
  const std::vector<Lit> lit = lit_pixels(scan);
  if (lit.size() < fewest_normals) return result;
  std::vector<double> seen;
  for (const Lit& pixel : lit) seen.push_back(pixel.light);
  const double middle = median(seen);
  if (!(middle > 0)) return result;
  Harmonics light = Harmonics::Zero();
  light[0] = middle;
  for (int round = 0; round < rounds; ++round) {
    // Held to what is about it where normals tell nothing: a plane has one.
    Eigen::Matrix<double, terms, terms> sums = Eigen::Matrix<double, terms, terms>::Identity();
    sums *= 1e-6 * static_cast<double>(lit.size());
    Harmonics sides = Harmonics::Zero();
    for (const Lit& pixel : lit) {
      const double off = (pixel.light - light.dot(pixel.normal)) / (options.wild * middle);
      const double weight = 1 / (1 + off * off);
      sums += weight * pixel.normal * pixel.normal.transpose();
      sides += weight * pixel.light * pixel.normal;
    }
    light = sums.ldlt().solve(sides);
  }
  const int channels = scan.picture.channels;
  for (const Lit& pixel : lit) {
    const double gain = middle / std::max(light.dot(pixel.normal), options.least_light * middle);
    std::uint8_t* p = result.picture.pixels.data() + pixel.pixel * static_cast<std::size_t>(channels);
    for (int c = 0; c < channels; ++c)
      p[c] = static_cast<std::uint8_t>(std::lround(255 * std::min(srgb_of(gain * linear_of(p[c] / 255.0)), 1.0)));
  }
  return result;
}

}  // namespace face::mask
