// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/picture_level.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "nodes/render/rgb_image.h"

namespace face::model {
namespace {

constexpr double blur_px = 0.7;

}  // namespace

PictureLevel make_level(const Image& picture, double factor, double exposure) {
  const Image rgb = render::rgb_image(picture);
  cv::Mat source(rgb.height, rgb.width, CV_8UC3, const_cast<std::uint8_t*>(rgb.pixels.data())), small;
  PictureLevel level;
  level.width = std::max(8, static_cast<int>(std::lround(rgb.width * factor)));
  level.height = std::max(8, static_cast<int>(std::lround(rgb.height * factor)));
  level.factor = static_cast<double>(level.width) / rgb.width;
  source.convertTo(small, CV_32FC3, 1.0 / (255.0 * exposure));
  cv::resize(small, small, {level.width, level.height}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(small, small, {0, 0}, blur_px);
  level.samples.resize(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
  const auto at = [&](int x, int y) {
    return small.at<cv::Vec3f>(std::clamp(y, 0, level.height - 1), std::clamp(x, 0, level.width - 1));
  };
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      auto& s = level.samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) +
                              static_cast<std::size_t>(x)];
      const cv::Vec3f here = at(x, y), right = at(x + 1, y), left = at(x - 1, y), down = at(x, y + 1),
                      up = at(x, y - 1);
      for (int c = 0; c < 3; ++c) {
        s[static_cast<std::size_t>(c)] = here[c];
        s[static_cast<std::size_t>(3 + c)] = 0.5f * (right[c] - left[c]);
        s[static_cast<std::size_t>(6 + c)] = 0.5f * (down[c] - up[c]);
      }
    }
  return level;
}

std::array<float, 9> sample_at(const PictureLevel& level, double x_px, double y_px) {
  const double x = std::clamp(x_px, 0.0, level.width - 1.001), y = std::clamp(y_px, 0.0, level.height - 1.001);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const auto fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  const std::array<float, 9>* row = level.samples.data() +
                                    static_cast<std::size_t>(y0) * static_cast<std::size_t>(level.width) +
                                    static_cast<std::size_t>(x0);
  const std::array<float, 9>* below = row + level.width;
  std::array<float, 9> result;
  for (std::size_t i = 0; i < 9; ++i)
    result[i] = (1 - fy) * ((1 - fx) * row[0][i] + fx * row[1][i]) + fy * ((1 - fx) * below[0][i] + fx * below[1][i]);
  return result;
}

}  // namespace face::model
