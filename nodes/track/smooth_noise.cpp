// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/smooth_noise.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "nodes/base/quantile.h"
#include "nodes/track/face_colours.h"
#include "nodes/track/patch.h"

namespace face::track {
namespace {

constexpr double clean = 2.5, noisy = 5;  // grey values; clips of the GRID corpus have 0.5
constexpr double most_px = 1;

}  // namespace

double noise_level(const Image& image, const Landmarks& points) {
  constexpr double margin_px = 10;
  constexpr double norm = 6, median_of_normal = 0.6745;  // root of the mask's squares; of a deviation of 1
  Box box;
  for (const Landmark& point : points.points) box.include(point.x_px, point.y_px);
  const int left = std::max(1, static_cast<int>(box.left - margin_px));
  const int right = std::min(image.width - 2, static_cast<int>(box.right + margin_px));
  const int top = std::max(1, static_cast<int>(box.top - margin_px));
  const int bottom = std::min(image.height - 2, static_cast<int>(box.bottom + margin_px));
  if (left > right || top > bottom) return 0;
  const Grey grey = grey_of(image, left - 1, top - 1, right - left + 3, bottom - top + 3);
  std::vector<double> sizes;
  for (int y = 1; y + 1 < grey.height; ++y)
    for (int x = 1; x + 1 < grey.width; ++x) {
      const float* row = &grey.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(grey.width) +
                                      static_cast<std::size_t>(x)];
      const float *above = row - grey.width, *below = row + grey.width;
      const float corners = above[-1] + above[1] + below[-1] + below[1], sides = above[0] + below[0] + row[-1] + row[1];
      sizes.push_back(std::abs(static_cast<double>(corners - 2 * sides + 4 * row[0])));
    }
  return median(std::move(sizes)) / norm / median_of_normal;
}

const Image& without_noise(const Image& image, const Landmarks& points, Image& room) {
  const double share = std::clamp((noise_level(image, points) - clean) / (noisy - clean), 0.0, 1.0);
  if (share == 0) return image;
  room = image;
  const int type = CV_8UC(image.channels);
  const cv::Mat from(image.height, image.width, type, const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat to(image.height, image.width, type, room.pixels.data());
  const double bell_px = most_px * share;
  cv::GaussianBlur(from, to, cv::Size(7, 7), bell_px, bell_px, cv::BORDER_REPLICATE);
  return room;
}

Image smooth_noise(const Image& image, const Landmarks& points) {
  Image room;
  return without_noise(image, points, room);
}

}  // namespace face::track
