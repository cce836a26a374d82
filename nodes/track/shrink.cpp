// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/shrink.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "nodes/base/find_landmark.h"
#include "nodes/track/face_colours.h"
#include "nodes/track/patch.h"

namespace face::track {

Shrink::Shrink(int width, int height, double times)
    : full_width_(width),
      full_height_(height),
      width_(std::max(1, static_cast<int>(std::lround(width / times)))),
      height_(std::max(1, static_cast<int>(std::lround(height / times)))) {}

namespace {

Image resized(const Image& from, int width, int height, int interpolation) {
  Image to{width, height, from.channels, {}};
  to.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                   static_cast<std::size_t>(from.channels));
  const int type = CV_8UC(from.channels);
  const cv::Mat source(from.height, from.width, type, const_cast<std::uint8_t*>(from.pixels.data()));
  cv::Mat target(height, width, type, to.pixels.data());
  cv::resize(source, target, target.size(), 0, 0, interpolation);
  return to;
}

}  // namespace

Image Shrink::image(const Image& full) const {
  return resized(full, width_, height_, width_ < full_width_ ? cv::INTER_AREA : cv::INTER_CUBIC);
}

Image Shrink::full(const Image& small) const { return resized(small, full_width_, full_height_, cv::INTER_CUBIC); }

Landmarks Shrink::to_small(Landmarks points) const {
  for (Landmark& point : points.points) {
    point.x_px = scaled_px(point.x_px, full_width_, width_);
    point.y_px = scaled_px(point.y_px, full_height_, height_);
  }
  return points;
}

Landmarks Shrink::to_full(Landmarks points) const {
  for (Landmark& point : points.points) {
    point.x_px = scaled_px(point.x_px, width_, full_width_);
    point.y_px = scaled_px(point.y_px, height_, full_height_);
  }
  return points;
}

double lost_contrast(const Image& frame, const Shrink& shrink, const Landmarks& points, double margin_px) {
  Box box;
  for (const Landmark& point : points.points) box.include(point.x_px, point.y_px);
  const auto inside = [](double value, int size) { return static_cast<int>(std::clamp(value, 0.0, size - 1.0)); };
  const int left = inside(box.left - margin_px, frame.width), right = inside(box.right + margin_px, frame.width);
  const int top = inside(box.top - margin_px, frame.height), bottom = inside(box.bottom + margin_px, frame.height);
  const Grey sharp = grey_of(frame), soft = grey_of(shrink.full(shrink.image(frame)));
  double sum = 0, squares = 0, lost = 0, count = 0;
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x, ++count) {
      const auto value = static_cast<double>(sharp.at(x, y));
      sum += value;
      squares += value * value;
      lost += std::pow(value - static_cast<double>(soft.at(x, y)), 2);
    }
  return std::sqrt(lost / std::max(1e-9, squares - sum * sum / count));
}

}  // namespace face::track
