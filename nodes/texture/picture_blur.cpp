// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/picture_blur.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/render/rgb_image.h"

namespace face::texture {
namespace {

constexpr double blur_px = 1;         // the one more
constexpr double of_slope = 1.0 / 3;  // variance that a slope over two pixels adds to an edge's own
constexpr double strong = 0.98;       // quantile of the slopes in the mask, from which on they are edges
constexpr double least_slope = 4;     // grey levels a pixel: below, grain
constexpr double least_px = 0.3;      // of a box as large as a pixel
constexpr double most_px = 3;
constexpr std::size_t least_edges = 20;

cv::Mat slope_of(const cv::Mat& grey) {
  cv::Mat x, y, slope;
  const cv::Mat difference = (cv::Mat_<float>(1, 3) << -0.5f, 0, 0.5f);
  cv::filter2D(grey, x, CV_32F, difference);
  cv::filter2D(grey, y, CV_32F, difference.t());
  cv::magnitude(x, y, slope);
  return slope;
}

}  // namespace

double picture_blur_px(const Image& picture, const Image& mask) {
  const Image rgb = render::rgb_image(picture);
  check(mask.width == rgb.width && mask.height == rgb.height, "the mask is ", mask.width, " x ", mask.height,
        " pixels, the picture ", rgb.width, " x ", rgb.height);
  cv::Mat grey, blurred;
  cv::cvtColor(cv::Mat(rgb.height, rgb.width, CV_8UC3, const_cast<std::uint8_t*>(rgb.pixels.data())), grey,
               cv::COLOR_RGB2GRAY);
  grey.convertTo(grey, CV_32F);
  cv::GaussianBlur(grey, blurred, {0, 0}, blur_px);
  const cv::Mat slope = slope_of(grey), after = slope_of(blurred);
  std::vector<double> slopes;
  for (int y = 0; y < rgb.height; ++y)
    for (int x = 0; x < rgb.width; ++x)
      if (mask.pixels[static_cast<std::size_t>(y * rgb.width + x)] > 127) slopes.push_back(slope.at<float>(y, x));
  if (slopes.empty()) return least_px;
  const double limit = std::max(least_slope, quantile(slopes, strong));
  // Of all edges together: grain and blocks make single ones look sharper than they are, or softer.
  double squares = 0, squares_after = 0;
  std::size_t edges = 0;
  for (int y = 1; y + 1 < rgb.height; ++y)
    for (int x = 1; x + 1 < rgb.width; ++x) {
      const float here = slope.at<float>(y, x);
      if (mask.pixels[static_cast<std::size_t>(y * rgb.width + x)] <= 127 || here < limit) continue;
      // The middle of an edge is the steepest across it.
      const bool across = here >= slope.at<float>(y, x - 1) && here >= slope.at<float>(y, x + 1);
      const bool along = here >= slope.at<float>(y - 1, x) && here >= slope.at<float>(y + 1, x);
      if (!across && !along) continue;
      ++edges;
      squares += std::pow(static_cast<double>(here), 2);
      squares_after += std::pow(static_cast<double>(after.at<float>(y, x)), 2);
    }
  if (edges < least_edges || squares <= squares_after) return least_px;
  const double variance = blur_px * blur_px * squares_after / (squares - squares_after) - of_slope;
  return std::clamp(std::sqrt(std::max(0.0, variance)), least_px, most_px);
}

}  // namespace face::texture
