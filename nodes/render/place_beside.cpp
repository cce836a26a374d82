// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/place_beside.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "nodes/base/check.h"
#include "nodes/render/rgb_image.h"

namespace face::render {
namespace {

cv::Mat brought_to(const Image& image, int height_px) {
  check(image.width > 0 && image.height > 0, "a picture is ", image.width, " x ", image.height,
        " pixels, expected at least 1 x 1");
  Image rgb = rgb_image(image);
  const cv::Mat whole(rgb.height, rgb.width, CV_8UC3, rgb.pixels.data());
  const int width = std::max(1, static_cast<int>(std::lround(static_cast<double>(rgb.width) * height_px / rgb.height)));
  cv::Mat scaled;
  cv::resize(whole, scaled, {width, height_px}, 0, 0, height_px < rgb.height ? cv::INTER_AREA : cv::INTER_LINEAR);
  return scaled;
}

}  // namespace

Image place_beside(const Image& left, const Image& right, const PlaceBesideOptions& options) {
  check(options.height_px > 0 && options.height_px % 2 == 0, "height_px is ", options.height_px,
        ", expected an even number");
  const cv::Mat a = brought_to(left, options.height_px), b = brought_to(right, options.height_px);
  Image both;
  both.width = (a.cols + b.cols + 1) / 2 * 2;
  both.height = options.height_px;
  both.pixels.assign(static_cast<std::size_t>(both.width) * static_cast<std::size_t>(both.height) * 3, 0);
  cv::Mat whole(both.height, both.width, CV_8UC3, both.pixels.data());
  a.copyTo(whole(cv::Rect(0, 0, a.cols, a.rows)));
  b.copyTo(whole(cv::Rect(a.cols, 0, b.cols, b.rows)));
  return both;
}

}  // namespace face::render
