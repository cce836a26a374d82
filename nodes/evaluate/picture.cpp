// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/picture.h"

#include <cmath>
#include <limits>

#include "nodes/base/check.h"
#include "nodes/base/luma.h"
#include "nodes/evaluate/statistics.h"
#include "nodes/render/rgb_image.h"

namespace face::evaluate {
namespace {

// Sums of squared central differences over the pixels whose neighbours count.
double gradient_energy(const Image& rgb, const std::vector<bool>& counts) {
  const auto width = static_cast<std::size_t>(rgb.width), height = static_cast<std::size_t>(rgb.height);
  const auto brightness = [&](std::size_t i) { return grey_value<double>(&rgb.pixels[3 * i], 3); };
  double sum = 0;
  for (std::size_t y = 1; y + 1 < height; ++y)
    for (std::size_t x = 1; x + 1 < width; ++x) {
      const std::size_t i = y * width + x;
      if (!counts[i] || !counts[i - 1] || !counts[i + 1] || !counts[i - width] || !counts[i + width]) continue;
      const double dx = (brightness(i + 1) - brightness(i - 1)) / 2;
      const double dy = (brightness(i + width) - brightness(i - width)) / 2;
      sum += dx * dx + dy * dy;
    }
  return sum;
}

}  // namespace

std::vector<bool> counted_pixels(const Image& picture, const Image& truth, const Image* mask) {
  check(picture.width == truth.width && picture.height == truth.height, "picture is ", picture.width, " x ",
        picture.height, ", truth is ", truth.width, " x ", truth.height);
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  if (!mask) return std::vector<bool>(pixels, true);
  check(mask->width == truth.width && mask->height == truth.height, "mask is ", mask->width, " x ", mask->height,
        ", truth is ", truth.width, " x ", truth.height);
  const Image rgb = render::rgb_image(*mask);
  std::vector<bool> counts(pixels);
  for (std::size_t i = 0; i < pixels; ++i) counts[i] = rgb.pixels[3 * i] >= 128;
  return counts;
}

Table picture(const Image& picture, const Image& truth, const Image* mask) {
  const Image own = render::rgb_image(picture), real = render::rgb_image(truth);
  const std::vector<bool> counts = counted_pixels(picture, truth, mask);
  double sum = 0, pixels = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (!counts[i]) continue;
    ++pixels;
    for (std::size_t c = 0; c < 3; ++c) {
      const double difference = double(own.pixels[3 * i + c]) - real.pixels[3 * i + c];
      sum += difference * difference;
    }
  }
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const double rms = pixels > 0 ? std::sqrt(sum / (3 * pixels)) : nothing;
  const double psnr = rms == 0 ? std::numeric_limits<double>::infinity() : 20 * std::log10(255 / rms);
  return one_row("all", {"rms_levels", "psnr_db", "gradient_ratio", "pixels"},
                 {rms, psnr, percent_of(gradient_energy(own, counts), gradient_energy(real, counts)) / 100, pixels});
}

}  // namespace face::evaluate
