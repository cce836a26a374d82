// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/sample_image.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/keys_cubic.h"

namespace face {
namespace {

void cubic(double t, float* w) {
  const std::array<double, 4> weights = keys_weights(t);
  for (std::size_t i = 0; i < weights.size(); ++i) w[i] = static_cast<float>(weights[i]);
}

}  // namespace

void sample_image(const Image& image, double x_px, double y_px, float* values) {
  const double x = std::clamp(x_px, 0.0, image.width - 1.0), y = std::clamp(y_px, 0.0, image.height - 1.0);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  float wx[4], wy[4];
  cubic(x - left, wx);
  cubic(y - top, wy);
  const auto channels = static_cast<std::size_t>(image.channels);
  const std::size_t stride = channels * static_cast<std::size_t>(image.width);
  if (channels == 3 && left >= 1 && top >= 1 && left + 2 < image.width && top + 2 < image.height) {
    // Within: the same sums without a look at the edges. Frames are mostly that, and this is where their time goes.
    const std::uint8_t* row =
        image.pixels.data() + static_cast<std::size_t>(top - 1) * stride + 3 * static_cast<std::size_t>(left - 1);
    float sum[3] = {0, 0, 0};
    for (int j = 0; j < 4; ++j, row += stride)
      for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c) sum[c] += wy[j] * wx[i] * static_cast<float>(row[3 * i + c]);
    for (int c = 0; c < 3; ++c) values[c] = sum[c];
    return;
  }
  for (int c = 0; c < image.channels; ++c) values[c] = 0;
  for (int j = 0; j < 4; ++j) {
    const auto row = static_cast<std::size_t>(std::clamp(top + j - 1, 0, image.height - 1));
    for (int i = 0; i < 4; ++i) {
      const auto column = static_cast<std::size_t>(std::clamp(left + i - 1, 0, image.width - 1));
      for (std::size_t c = 0; c < channels; ++c)
        values[c] += wy[j] * wx[i] * static_cast<float>(image.pixels[row * stride + column * channels + c]);
    }
  }
}

std::uint8_t to_byte(double value) { return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L)); }

}  // namespace face
