// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/draw_scan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/phantom/vector3.h"
#include "nodes/render/rgb_image.h"

namespace face::phantom {
namespace {

// The left half; place(x, y) is where a measured pixel lies, towards the viewer from it the direction of the scanner.
template <class Place, class Towards>
Image side_by_side(const std::vector<float>& measured, const Image& picture, Place place, Towards towards) {
  const int width = picture.width, height = picture.height;
  check(measured.size() == static_cast<std::size_t>(std::max(0, width)) * static_cast<std::size_t>(std::max(0, height)),
        "the scan has ", measured.size(), " values, but its picture is ", width, " x ", height);
  const Image colours = render::rgb_image(picture);
  Image image{2 * width, height, 3, {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(height) * 3);
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  // The neighbours' difference, one-sided where one of them is missing.
  const auto slope = [&](int x, int y, int dx, int dy, Vector3& difference) {
    const auto holds = [&](int i, int j) {
      return i >= 0 && j >= 0 && i < width && j < height && measured[at(i, j)] > 0;
    };
    const bool after = holds(x + dx, y + dy), before = holds(x - dx, y - dy);
    if (!after && !before) return false;
    difference = (after ? place(x + dx, y + dy) : place(x, y)) - (before ? place(x - dx, y - dy) : place(x, y));
    return true;
  };
  for (int y = 0; y < height; ++y) {
    std::uint8_t* row = &image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) * 3];
    std::copy_n(&colours.pixels[at(0, y) * 3], width * 3, row + width * 3);
    for (int x = 0; x < width; ++x) {
      std::uint8_t* out = row + 3 * x;
      Vector3 right, down;
      if (!(measured[at(x, y)] > 0) || !slope(x, y, 1, 0, right) || !slope(x, y, 0, 1, down)) {
        out[0] = 90, out[1] = 10, out[2] = 10;
        continue;
      }
      const Vector3 normal = unit(cross(down, right));
      const Vector3 viewer = unit(towards(x, y));
      const Vector3 beside = unit(cross({0, 1, 0}, viewer));
      const Vector3 light = unit(viewer + 0.35 * beside + Vector3{0, 0.45, 0});
      const double shade = 0.12 + 0.88 * std::max(0.0, dot(normal, light));
      const auto level = static_cast<std::uint8_t>(std::lround(235 * std::min(1.0, shade)));
      out[0] = out[1] = out[2] = level;
    }
  }
  return image;
}

}  // namespace

Image draw_scan(const DepthScan& scan) {
  const auto place = [&](int x, int y) {
    const double depth = scan.depth_mm[static_cast<std::size_t>(y) * static_cast<std::size_t>(scan.picture.width) +
                                       static_cast<std::size_t>(x)];
    const double scale = depth / scan.camera.focal_px;
    return Vector3{(x - scan.camera.centre_x_px) * scale, (scan.camera.centre_y_px - y) * scale, -depth};
  };
  return side_by_side(scan.depth_mm, scan.picture, place, [](int, int) { return Vector3{0, 0, 1}; });
}

Image draw_laser_scan(const CylinderScan& scan) {
  const auto ray = [&](int x, int) {
    const double phi = (x - 0.5 * (scan.picture.width - 1)) * scan.phi_step_rad;
    return Vector3{std::sin(phi), 0, std::cos(phi)};
  };
  const auto place = [&](int x, int y) {
    const double radius = scan.radius_mm[static_cast<std::size_t>(y) * static_cast<std::size_t>(scan.picture.width) +
                                         static_cast<std::size_t>(x)];
    return ray(x, y) * radius + Vector3{0, -y * static_cast<double>(scan.step_mm), 0};
  };
  return side_by_side(scan.radius_mm, scan.picture, place, ray);
}

}  // namespace face::phantom
