// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/draw_landmarks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "nodes/base/check.h"
#include "nodes/render/rgb_image.h"

namespace face::render {
namespace {

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour tracked = {60, 230, 90}, lost = {240, 60, 50}, outline = {10, 20, 10};

constexpr double full_size_px = 640;  // of a picture whose dots have the radius that is asked for

void blend(Image& image, int x, int y, const Colour& colour, double opacity) {
  std::uint8_t* pixel =
      &image
           .pixels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) *
                   3];
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] = static_cast<std::uint8_t>(pixel[c] + opacity * (colour[c] - pixel[c]) + 0.5);
}

// A disk with a dark edge, or the edge alone in the colour; smooth at its rim.
void draw_dot(Image& image, const Landmark& point, double radius_px) {
  const double reach = radius_px + 2;
  const int x0 = std::max(0, static_cast<int>(std::floor(point.x_px - reach)));
  const int y0 = std::max(0, static_cast<int>(std::floor(point.y_px - reach)));
  const int x1 = std::min(image.width - 1, static_cast<int>(std::ceil(point.x_px + reach)));
  const int y1 = std::min(image.height - 1, static_cast<int>(std::ceil(point.y_px + reach)));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const double distance = std::hypot(x - point.x_px, y - point.y_px);
      const double disk = std::clamp(radius_px + 0.5 - distance, 0.0, 1.0);
      const double ring = std::clamp(1.0 - std::abs(distance - radius_px), 0.0, 1.0);
      if (point.valid) {
        blend(image, x, y, outline, 0.6 * ring);
        blend(image, x, y, tracked, std::clamp(radius_px - distance, 0.0, 1.0));
      } else if (disk + ring > 0) {
        blend(image, x, y, lost, ring);
      }
    }
}

}  // namespace

Image draw_landmarks(const Image& frame, const Landmarks& landmarks, const DrawLandmarksOptions& options) {
  check(options.radius_px > 0, "radius_px is ", options.radius_px, ", expected more than 0");
  Image image = rgb_image(frame);
  // Larger pictures are looked at from farther away, or made smaller.
  const double radius_px = options.radius_px * std::max(1.0, std::max(image.width, image.height) / full_size_px);
  const double margin = radius_px + 2;
  for (const Landmark& point : landmarks.points) {
    const bool near = point.x_px > -margin && point.y_px > -margin && point.x_px < image.width + margin &&
                      point.y_px < image.height + margin;  // false for NaN as well
    if (near) draw_dot(image, point, radius_px);
  }
  return image;
}

}  // namespace face::render
