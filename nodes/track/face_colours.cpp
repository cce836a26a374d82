// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/face_colours.h"

#include <cmath>

namespace face::track {

FaceColours::FaceColours(const Image& image, const Box& box, double margin_px) {
  const auto clamped = [](double value, int size) { return std::clamp(static_cast<int>(value), 0, size - 1); };
  const int x0 = clamped(box.left - margin_px, image.width), x1 = clamped(box.right + margin_px + 1, image.width);
  const int y0 = clamped(box.top - margin_px, image.height), y1 = clamped(box.bottom + margin_px + 1, image.height);
  Image part{x1 - x0 + 1, y1 - y0 + 1, image.channels, {}};
  const auto stride = static_cast<std::size_t>(image.channels);
  for (int y = y0; y <= y1; ++y) {
    const auto begin = image.pixels.begin() + (static_cast<std::ptrdiff_t>(y) * image.width + x0) * image.channels;
    part.pixels.insert(part.pixels.end(), begin, begin + static_cast<std::ptrdiff_t>(part.width) * image.channels);
  }
  left_ = x0, top_ = y0;
  red_ = blue_ = {part.width, part.height, {}};
  luma_ = grey_of(part);
  for (float& value : luma_.values) value /= 255;
  for (std::size_t i = 0; i < part.pixels.size(); i += stride) {
    const auto log_of = [&](std::size_t k) { return std::log(static_cast<float>(part.pixels[i + k]) + 8.0f); };
    red_.values.push_back(stride < 3 ? 0 : log_of(0) - log_of(1));
    blue_.values.push_back(stride < 3 ? 0 : log_of(2) - log_of(1));
  }
}

std::array<double, 3> FaceColours::at(double x_px, double y_px) const {
  const double x = x_px - left_, y = y_px - top_;
  return {static_cast<double>(red_.at(x, y)), static_cast<double>(blue_.at(x, y)), static_cast<double>(luma_.at(x, y))};
}

double FaceColours::luma_at(double x_px, double y_px) const {
  return static_cast<double>(luma_.at(x_px - left_, y_px - top_));
}

}  // namespace face::track
