// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/picture_level.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "nodes/render/rgb_image.h"

namespace face::model {
namespace {

constexpr double blur_px = 0.7;

cv::Mat numbers_of(const Image& picture, double exposure) {
  const Image rgb = render::rgb_image(picture);
  const cv::Mat source(rgb.height, rgb.width, CV_8UC3, const_cast<std::uint8_t*>(rgb.pixels.data()));
  cv::Mat numbers;
  source.convertTo(numbers, CV_32FC3, 1.0 / (255.0 * exposure));
  return numbers;
}

}  // namespace

PictureLevel make_level(const Image& picture, double factor, double exposure) {
  return std::move(make_levels(picture, {factor}, exposure).front());
}

std::vector<PictureLevel> make_levels(const Image& picture, const std::vector<double>& factors, double exposure) {
  std::vector<PictureLevel> levels(factors.size());
  const cv::Mat numbers = numbers_of(picture, exposure);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    PictureLevel& level = levels[i];
    cv::Mat sharp = numbers;
    level.width = std::max(8, static_cast<int>(std::lround(picture.width * factors[i])));
    level.height = std::max(8, static_cast<int>(std::lround(picture.height * factors[i])));
    level.factor = static_cast<double>(level.width) / picture.width;
    level.colours.resize(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
    cv::Mat colours(level.height, level.width, CV_32FC3, level.colours.data());
    if (sharp.size() != colours.size()) cv::resize(numbers, sharp, colours.size(), 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(sharp, colours, {0, 0}, blur_px);
  }
  return levels;
}

namespace {

// The pixel above and to the left of a place, and how far the place is from it.
struct Between {
  Between(const PictureLevel& level, double x_px, double y_px) {
    const double x = std::clamp(x_px, 0.0, level.width - 1.001), y = std::clamp(y_px, 0.0, level.height - 1.001);
    x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  }
  // Of the values of that pixel, its right neighbour, and the two below.
  float operator()(float a, float b, float c, float d) const {
    return (1 - fy) * ((1 - fx) * a + fx * b) + fy * ((1 - fx) * c + fx * d);
  }
  int x0, y0;
  float fx, fy;
};

}  // namespace

Vec3f colour_at(const PictureLevel& level, double x_px, double y_px) {
  const Between between(level, x_px, y_px);
  const Vec3f* const here = level.colours.data() +
                            static_cast<std::size_t>(between.y0) * static_cast<std::size_t>(level.width) +
                            static_cast<std::size_t>(between.x0);
  const Vec3f* const below = here + level.width;
  Vec3f colour;
  for (std::size_t c = 0; c < 3; ++c) colour[c] = between(here[0][c], here[1][c], below[0][c], below[1][c]);
  return colour;
}

std::array<float, 9> sample_at(const PictureLevel& level, double x_px, double y_px) {
  const Between between(level, x_px, y_px);
  // What is read: 4 x 4 pixels but for their corners.
  std::array<std::array<const Vec3f*, 4>, 4> around;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const auto px = static_cast<std::size_t>(std::clamp(between.x0 + column - 1, 0, level.width - 1)),
                 py = static_cast<std::size_t>(std::clamp(between.y0 + row - 1, 0, level.height - 1));
      around[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          level.colours.data() + py * static_cast<std::size_t>(level.width) + px;
    }
  const auto& [above, here, below, last] = around;
  std::array<float, 9> result;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto slope = [c](const Vec3f* from, const Vec3f* to) { return 0.5f * ((*to)[c] - (*from)[c]); };
    result[c] = between((*here[1])[c], (*here[2])[c], (*below[1])[c], (*below[2])[c]);
    result[3 + c] =
        between(slope(here[0], here[2]), slope(here[1], here[3]), slope(below[0], below[2]), slope(below[1], below[3]));
    result[6 + c] =
        between(slope(above[1], below[1]), slope(above[2], below[2]), slope(here[1], last[1]), slope(here[2], last[2]));
  }
  return result;
}

}  // namespace face::model
