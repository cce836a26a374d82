// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/continue_background.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/render/rgb_image.h"

namespace face::texture {

double face_scale_px(const FaceFit& fit) {
  double squares = 0;
  for (const float x : fit.camera.position_mm) squares += static_cast<double>(x) * x;
  return fit.camera.focal_px / std::sqrt(squares);  // the head's origin is inside the head
}

Image continue_background(const Image& picture, const Image& mask, const FaceFit& fit,
                          const ContinueBackgroundOptions& options) {
  check(mask.width == picture.width && mask.height == picture.height && mask.channels == 1, "the mask is ", mask.width,
        " x ", mask.height, " with ", mask.channels, " channels, expected ", picture.width, " x ", picture.height,
        " with 1");
  check(mask.pixels.size() == static_cast<std::size_t>(std::max(0, mask.width)) *
                                  static_cast<std::size_t>(std::max(0, mask.height)) &&
            !mask.pixels.empty(),
        "the mask of ", mask.width, " x ", mask.height, " has ", mask.pixels.size(), " pixels");
  const Image source = render::rgb_image(picture);
  Image result = source;
  const double scale = face_scale_px(fit);
  const auto width = static_cast<std::size_t>(source.width);
  // Distance to the nearest pixel outside, and which that is.
  cv::Mat inside(source.height, source.width, CV_8U), distance, labels;
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) inside.data[i] = mask.pixels[i] > 127 ? 255 : 0;
  const int margin = static_cast<int>(std::lround(options.margin_mm * scale));
  if (margin > 0)
    cv::dilate(inside, inside, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * margin + 1, 2 * margin + 1}));
  if (cv::countNonZero(inside) == static_cast<int>(inside.total())) return result;
  cv::distanceTransform(inside, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  double most = 0;
  cv::minMaxLoc(labels, nullptr, &most);
  std::vector<cv::Point> outside(static_cast<std::size_t>(most) + 1);
  for (int y = 0; y < source.height; ++y)
    for (int x = 0; x < source.width; ++x)
      if (inside.at<std::uint8_t>(y, x) == 0) outside[static_cast<std::size_t>(labels.at<int>(y, x))] = {x, y};
  for (int y = 0; y < source.height; ++y)
    for (int x = 0; x < source.width; ++x) {
      if (inside.at<std::uint8_t>(y, x) == 0 || distance.at<float>(y, x) > options.stripe_mm * scale) continue;
      // The nearest pixel outside is at -d g; its far side, twice as far, has the colour.
      const cv::Point nearest = outside[static_cast<std::size_t>(labels.at<int>(y, x))];
      const int sx = std::clamp(2 * nearest.x - x, 0, source.width - 1);
      const int sy = std::clamp(2 * nearest.y - y, 0, source.height - 1);
      for (std::size_t c = 0; c < 3; ++c)
        result.pixels[3 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)) + c] =
            source.pixels[3 * (static_cast<std::size_t>(sy) * width + static_cast<std::size_t>(sx)) + c];
    }
  return result;
}

}  // namespace face::texture
