// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/grey_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "nodes/base/luma.h"

namespace face {
namespace {

int mirrored(int i, int count) { return count < 2 ? 0 : i < 0 ? -i : i >= count ? 2 * count - 2 - i : i; }

// Samples to coefficients in place, every `step`-th of `count`, mirrored at both ends (Unser, box 2).
void filter(double* first, int step, int count) {
  if (count < 2) return;
  const double pole = std::sqrt(3.0) - 2;
  const auto c = [&](int i) -> double& { return first[static_cast<std::ptrdiff_t>(i) * step]; };
  constexpr int horizon = 24;  // pole^24 is 2e-14
  double sum = 0, power = 1;
  for (int i = 0; i < horizon; ++i, power *= pole) {
    const int period = 2 * count - 2;
    sum += power * c(mirrored(i % period, count));
  }
  c(0) = sum;
  for (int i = 1; i < count; ++i) c(i) += pole * c(i - 1);
  c(count - 1) = pole / (pole * pole - 1) * (c(count - 1) + pole * c(count - 2));
  for (int i = count - 2; i >= 0; --i) c(i) = pole * (c(i + 1) - c(i));
  for (int i = 0; i < count; ++i) c(i) *= 6;
}

std::array<double, 4> weights(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, 2.0 / 3 - t * t * (2 - t) / 2, 2.0 / 3 - s * s * (2 - s) / 2, t * t * t / 6};
}

}  // namespace

GreySpline::GreySpline(const Image& picture) : width_(picture.width), height_(picture.height) {
  const std::uint8_t* p = picture.pixels.data();
  coefficients_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int i = 0; i < width_ * height_; ++i, p += picture.channels)
    coefficients_.push_back(grey_value<double>(p, picture.channels));
  for (int y = 0; y < height_; ++y) filter(coefficients_.data() + static_cast<std::ptrdiff_t>(y) * width_, 1, width_);
  for (int x = 0; x < width_; ++x) filter(coefficients_.data() + x, width_, height_);
}

double GreySpline::at(double x_px, double y_px) const {
  const double x = std::clamp(x_px, 0.0, width_ - 1.0), y = std::clamp(y_px, 0.0, height_ - 1.0);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const std::array<double, 4> wx = weights(x - left), wy = weights(y - top);
  double sum = 0;
  for (int j = 0; j < 4; ++j) {
    const double* row = coefficients_.data() + static_cast<std::ptrdiff_t>(mirrored(top + j - 1, height_)) * width_;
    for (int i = 0; i < 4; ++i)
      sum += wy[static_cast<std::size_t>(j)] * wx[static_cast<std::size_t>(i)] * row[mirrored(left + i - 1, width_)];
  }
  return sum;
}

}  // namespace face
