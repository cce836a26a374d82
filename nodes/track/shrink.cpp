// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/shrink.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace face::track {

Shrink::Shrink(int width, int height, double times)
    : full_width_(width),
      full_height_(height),
      width_(std::max(1, static_cast<int>(std::lround(width / times)))),
      height_(std::max(1, static_cast<int>(std::lround(height / times)))) {}

Image Shrink::image(const Image& full) const {
  Image small{width_, height_, full.channels, {}};
  small.pixels.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) *
                      static_cast<std::size_t>(full.channels));
  const int type = CV_8UC(full.channels);
  const cv::Mat from(full.height, full.width, type, const_cast<std::uint8_t*>(full.pixels.data()));
  cv::Mat to(height_, width_, type, small.pixels.data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_AREA);
  return small;
}

Landmarks Shrink::to_small(Landmarks points) const {
  for (Landmark& point : points.points) {
    point.x_px = (point.x_px + 0.5) * width_ / full_width_ - 0.5;
    point.y_px = (point.y_px + 0.5) * height_ / full_height_ - 0.5;
  }
  return points;
}

Landmarks Shrink::to_full(Landmarks points) const {
  for (Landmark& point : points.points) {
    point.x_px = (point.x_px + 0.5) * full_width_ / width_ - 0.5;
    point.y_px = (point.y_px + 0.5) * full_height_ / height_ - 0.5;
  }
  return points;
}

}  // namespace face::track
