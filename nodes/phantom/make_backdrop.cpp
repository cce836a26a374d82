// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_backdrop.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/phantom/sensor_noise.h"
#include "nodes/phantom/vector3.h"

namespace face::phantom {
namespace {

// Smooth noise in [0, 1] with one random value at every lattice point.
double value_noise(const PixelNoise& noise, double x, double y) {
  const double column = std::floor(x), row = std::floor(y);
  const double u = smooth_step(0, 1, x - column), v = smooth_step(0, 1, y - row);
  const auto corner = [&](double dx, double dy) {
    const auto cx = static_cast<std::uint64_t>(static_cast<std::int64_t>(column + dx) + (1 << 20));
    const auto cy = static_cast<std::uint64_t>(static_cast<std::int64_t>(row + dy) + (1 << 20));
    return static_cast<double>(noise.uniform(cy << 24 | cx));
  };
  return lerp(lerp(corner(0, 0), corner(1, 0), u), lerp(corner(0, 1), corner(1, 1), u), v);
}

double blotches(const PixelNoise& noise, double x, double y) {
  double sum = 0, share = 0.5;
  for (int octave = 0; octave < 4; ++octave, share *= 0.5) {
    sum += share * value_noise(noise, x, y);
    x = 2 * x + 17.3;
    y = 2 * y + 5.1;
  }
  return sum / 0.9375;
}

}  // namespace

Image make_backdrop(const MakeBackdropOptions& options) {
  check(options.width_px > 0 && options.height_px > 0, "the backdrop is ", options.width_px, " x ", options.height_px,
        " pixels, expected at least 1 x 1");
  const PixelNoise shade(options.seed, "backdrop", 0), warmth(options.seed, "backdrop", 1),
      shelf(options.seed, "backdrop", 2);
  Image image{options.width_px, options.height_px, 3, {}};
  image.pixels.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double u = 6.0 * x / image.height, v = 6.0 * y / image.height;
      const double wall = blotches(shade, u, v) - 0.5, tint = blotches(warmth, 0.7 * u, 0.7 * v) - 0.5;
      // Upright things of uneven width and height on the lower half.
      const double place = 1.7 * u + 0.6 * value_noise(shelf, 1.1 * u, 40);
      const double top = 3.2 + 1.6 * value_noise(shelf, std::floor(place) * 3.7, 7);
      const double thing =
          smooth_step(top - 0.12, top + 0.12, v) * (value_noise(shelf, std::floor(place) * 5.3, 90) - 0.4) *
          smooth_step(0, 0.2, place - std::floor(place)) * smooth_step(1, 0.8, place - std::floor(place));
      const double light = options.contrast * (0.55 * wall + 0.7 * thing);
      const double colour =
          options.contrast * (0.35 * tint + 0.5 * thing * (value_noise(shelf, std::floor(place), 3) - 0.5));
      for (const double channel : {0.48 + light + colour, 0.47 + light, 0.45 + light - colour})
        image.pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(channel, 0.0, 1.0))));
    }
  return image;
}

}  // namespace face::phantom
