// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/structured_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/base/fringe_patterns.h"
#include "nodes/base/srgb.h"

namespace face::decode {
namespace {

constexpr double turn = 2 * std::numbers::pi;
using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Mean, amplitude and phases of a pixel's five levels.
struct Fringes {
  double mean = 0;
  double amplitude = 0;
  double fine = 0;  // phase in turns, [0, 1)
  double coarse = 0;
  double coarse_size = 0;  // 1 where coarse and fine fringes are equally strong
};

double turns(double sine, double cosine) {
  const double angle = std::atan2(sine, cosine) / turn;
  return angle < 0 ? angle + 1 : angle;
}

Fringes fringes_of(const std::array<double, FringePatterns::count>& level) {
  // level[1..3] = mean + amplitude cos(phase + 2 pi (k - 2) / 3).
  Fringes f;
  f.mean = (level[1] + level[2] + level[3]) / 3;
  const double cosine = (2 * level[2] - level[1] - level[3]) / 3;
  const double sine = (level[1] - level[3]) / std::sqrt(3.0);
  f.amplitude = std::hypot(cosine, sine);
  f.fine = turns(sine, cosine);
  f.coarse = turns(level[4] - f.mean, level[0] - f.mean);
  f.coarse_size = f.amplitude > 0 ? std::hypot(level[4] - f.mean, level[0] - f.mean) / f.amplitude : 0;
  return f;
}

// Meets camera rays with planes of projector columns.
class Triangulation {
 public:
  Triangulation(const Camera& camera, const Camera& projector) : camera_(camera), projector_(projector) {
    for (std::size_t i = 0; i < 3; ++i) baseline_[i] = double{projector.position_mm[i]} - camera.position_mm[i];
  }
  // The direction of a pixel's ray, 1 along the camera's axis, in the world.
  Vector ray(int x, int y) const {
    const double u = (x - camera_.centre_x_px) / camera_.focal_px, v = (camera_.centre_y_px - y) / camera_.focal_px;
    const auto& r = camera_.cam_from_world;
    return {r[0] * u + r[3] * v - r[6], r[1] * u + r[4] * v - r[7], r[2] * u + r[5] * v - r[8]};
  }
  // Depth along the camera's axis where the ray meets the plane of a projector column; <= 0 behind the camera.
  double depth(const Vector& ray, double column_px) const {
    const auto& r = projector_.cam_from_world;
    const double offset = column_px - projector_.centre_x_px;
    const Vector normal = {projector_.focal_px * r[0] + offset * r[6], projector_.focal_px * r[1] + offset * r[7],
                           projector_.focal_px * r[2] + offset * r[8]};
    const double towards = dot(normal, ray);
    return towards == 0 ? 0 : dot(normal, baseline_) / towards;
  }

 private:
  Camera camera_, projector_;
  Vector baseline_;
};

std::uint8_t srgb_code(double light) {
  const double clamped = std::clamp(light, 0.0, 1.0);
  return static_cast<std::uint8_t>(std::lround(255 * srgb_of(clamped)));
}

// The projector's column and the depth of a pixel; depth 0 where it cannot be decoded.
double depth_of(const Fringes& f, const Vector& ray, const FringePatterns& patterns, const Triangulation& triangulation,
                const StructuredLightOptions& options) {
  double found = 0;
  for (int period = 0; period < patterns.coarse_periods; ++period) {
    const double coarse_px = patterns.coarse_period_px() * (period + f.coarse);
    const double fine_count = coarse_px / patterns.fine_period_px() - f.fine;
    const double whole = std::round(fine_count);
    if (std::abs(fine_count - whole) > options.max_mismatch) continue;
    const double depth = triangulation.depth(ray, patterns.fine_period_px() * (whole + f.fine));
    if (depth < options.near_mm || depth > options.far_mm) continue;
    if (found > 0) return 0;  // two depths are possible
    found = depth;
  }
  return found;
}

}  // namespace

DepthScan structured_light(const engine::Seq<Image>& images, const Camera& camera, const Camera& projector,
                           const StructuredLightOptions& options) {
  constexpr double saturated = 254.5, weakest_coarse = 0.6, strongest_coarse = 1.4;
  check(images.size() == FringePatterns::count, "there are ", images.size(), " pattern images, expected ",
        FringePatterns::count);
  check(camera.focal_px > 0 && projector.focal_px > 0, "camera and projector have focal lengths of ", camera.focal_px,
        " and ", projector.focal_px, " px, expected more than 0");
  std::array<std::shared_ptr<const Image>, FringePatterns::count> held;
  for (std::size_t i = 0; i < held.size(); ++i) {
    held[i] = images.at(i);
    const Image &image = *held[i], &first = *held[0];
    check(image.channels == 1 && image.width > 0 && image.height > 0 && image.width == first.width &&
              image.height == first.height &&
              image.pixels.size() == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
          "pattern image ", images.id(i), " is ", image.width, " x ", image.height, " x ", image.channels,
          ", expected ", first.width, " x ", first.height, " x 1");
  }
  const FringePatterns patterns{options.projector_width_px, options.fine_periods, options.coarse_periods};
  const Triangulation triangulation(camera, projector);
  DepthScan scan;
  scan.camera = camera;
  scan.picture = {held[0]->width, held[0]->height, 1, {}};
  scan.picture.pixels.resize(held[0]->pixels.size());
  scan.depth_mm.assign(held[0]->pixels.size(), 0.0f);
  std::array<std::uint8_t, 511> code;  // of mean + amplitude, in steps of 1/2
  for (std::size_t i = 0; i < code.size(); ++i) code[i] = srgb_code(static_cast<double>(i) / 510);
  std::size_t pixel = 0;
  for (int y = 0; y < scan.picture.height; ++y)
    for (int x = 0; x < scan.picture.width; ++x, ++pixel) {
      std::array<double, FringePatterns::count> level;
      for (std::size_t i = 0; i < level.size(); ++i) level[i] = held[i]->pixels[pixel];
      const Fringes f = fringes_of(level);
      scan.picture.pixels[pixel] =
          code[static_cast<std::size_t>(std::lround(std::min(510.0, 2 * (f.mean + f.amplitude))))];
      if (f.amplitude < options.min_amplitude || *std::max_element(level.begin(), level.end()) > saturated) continue;
      if (f.coarse_size < weakest_coarse || f.coarse_size > strongest_coarse) continue;
      scan.depth_mm[pixel] = static_cast<float>(depth_of(f, triangulation.ray(x, y), patterns, triangulation, options));
    }
  return scan;
}

}  // namespace face::decode
