// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/sensor_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace face::phantom {
namespace {

// Along `count` values that are `stride` apart.
void blur_line(float* values, std::size_t count, std::size_t stride, const std::vector<float>& half,
               std::vector<float>& line) {
  line.resize(count);
  for (std::size_t i = 0; i < count; ++i) line[i] = values[i * stride];
  const std::size_t reach = half.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    float sum = half[0] * line[i], weight = half[0];
    for (std::size_t k = 1; k <= reach; ++k) {
      if (i >= k) sum += half[k] * line[i - k], weight += half[k];
      if (i + k < count) sum += half[k] * line[i + k], weight += half[k];
    }
    values[i * stride] = sum / weight;
  }
}

}  // namespace

std::vector<std::uint8_t> edges_of(const std::vector<float>& grey, PictureSize size, float least) {
  std::vector<std::uint8_t> edges(grey.size(), 0);
  const auto width = static_cast<std::size_t>(size.width_px), height = static_cast<std::size_t>(size.height_px);
  const auto compare = [&](std::size_t a, std::size_t b) {
    if (std::abs(grey[a] - grey[b]) > least) edges[a] = edges[b] = 1;
  };
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t at = y * width + x;
      if (x + 1 < width) compare(at, at + 1);
      if (y + 1 == height) continue;
      compare(at, at + width);
      if (x + 1 < width) compare(at, at + width + 1);
      if (x > 0) compare(at, at + width - 1);
    }
  return edges;
}

void blur_light(std::vector<float>& light, PictureSize size, double deviation_px) {
  std::vector<float> half, line;
  for (int k = 0; k <= static_cast<int>(std::ceil(3 * deviation_px)); ++k)
    half.push_back(static_cast<float>(std::exp(-0.5 * k * k / (deviation_px * deviation_px))));
  const auto width = static_cast<std::size_t>(size.width_px), height = static_cast<std::size_t>(size.height_px);
  for (std::size_t y = 0; y < height; ++y) blur_line(light.data() + y * width, width, 1, half, line);
  for (std::size_t x = 0; x < width; ++x) blur_line(light.data() + x, height, width, half, line);
}

}  // namespace face::phantom
