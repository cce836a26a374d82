// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/face_contrast.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "nodes/base/find_landmark.h"
#include "nodes/track/face_colours.h"

namespace face::track {
namespace {

// Of six speakers of the GRID corpus: 0.057 to 0.082, 0.05 to 0.16, 0.11 to 0.145.
constexpr std::array<double, 3> usual{0.068, 0.09, 0.128};
constexpr double least = 0.15, most = 3;
// Lengths in distances of the inner corners of the eyes.
constexpr double half_width = 1.2, above_eyes = 0.2, below_nose = 0.3, local = 0.35;
constexpr double eyes_small_px = 32;  // of the picture that is looked at

Image shrunk_part(const Image& image, const cv::Rect& part, const cv::Size& size) {
  const int type = CV_8UC(image.channels);
  const cv::Mat picture(image.height, image.width, type, const_cast<std::uint8_t*>(image.pixels.data()));  // only read
  Image small{size.width, size.height, image.channels, {}};
  small.pixels.resize(static_cast<std::size_t>(size.area()) * static_cast<std::size_t>(image.channels));
  cv::Mat out(size, type, small.pixels.data());
  cv::resize(picture(part), out, size, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

std::array<double, 3> face_contrast(const Image& image, const Landmarks& landmarks) {
  const Landmark *const right = find_landmark(landmarks, "eye_inner_r"),
                        *const left = find_landmark(landmarks, "eye_inner_l"),
                        *const nose = find_landmark(landmarks, "nose_tip");
  constexpr std::array<double, 3> none{1, 1, 1};
  if (!right || !left || !nose) return none;
  const double eyes_px = distance_px(*right, *left);
  if (!(eyes_px > 0)) return none;
  const double x_px = (right->x_px + left->x_px) / 2, y_px = (right->y_px + left->y_px) / 2;
  const double reach_px = local * eyes_px;
  const auto clamped = [](double value, int size) {
    return static_cast<int>(std::lround(std::clamp(value, 0.0, static_cast<double>(size))));
  };
  const int x0 = clamped(x_px - half_width * eyes_px - reach_px, image.width),
            x1 = clamped(x_px + half_width * eyes_px + reach_px, image.width),
            y0 = clamped(y_px - above_eyes * eyes_px - reach_px, image.height),
            y1 = clamped(nose->y_px + below_nose * eyes_px + reach_px, image.height);
  if (x1 - x0 < eyes_px || y1 - y0 < 4 * reach_px) return none;
  const double scale = std::min(1.0, eyes_small_px / eyes_px);
  const int width = static_cast<int>(std::lround((x1 - x0) * scale)),
            height = static_cast<int>(std::lround((y1 - y0) * scale));
  const int radius = std::max(1, static_cast<int>(std::lround(reach_px * scale)));
  if (width <= 2 * radius || height <= 2 * radius) return none;
  const FaceColours colours(shrunk_part(image, cv::Rect(x0, y0, x1 - x0, y1 - y0), {width, height}),
                            {0, 0, width - 1.0, height - 1.0}, 0);
  const cv::Rect inner(radius, radius, width - 2 * radius, height - 2 * radius);
  std::array<double, 3> contrast{};
  for (std::size_t c = 0; c < 3; ++c) {
    cv::Mat picture(height, width, CV_32F), mean;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) picture.at<float>(y, x) = static_cast<float>(colours.at(x, y)[c]);
    cv::blur(picture, mean, {2 * radius + 1, 2 * radius + 1});
    const double deviation =
        cv::norm(picture(inner), mean(inner), cv::NORM_L2) / std::sqrt(static_cast<double>(inner.area()));
    const double light = c == 2 ? std::max(0.02, cv::mean(picture(inner))[0]) : 1;
    contrast[c] = std::clamp(deviation / light / usual[c], least, most);
  }
  contrast[1] = std::max(contrast[0], contrast[1]);
  return contrast;
}

}  // namespace face::track
