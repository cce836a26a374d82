// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/follow_face.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/render/rgb_image.h"

namespace face::texture {
namespace {

constexpr double reach_mm = 25;   // from the outline, beyond which nothing moves
constexpr double steepest = 2.5;  // reach over the largest motion: less would fold the picture
constexpr double outside_mm = 6;  // of the mask, over which motion ends: a fit is never exact
constexpr double smooth_mm = 3;   // over which the outline's motion is smoothed
constexpr float least_alpha = 0.5f;

double fade(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return 1 - t * t * (3 - 2 * t);
}

}  // namespace

Image follow_face(const FaceLayer& layer, const Image& picture, const Image& mask, double scale) {
  const Image source = render::rgb_image(picture);
  check(source.width == layer.width && source.height == layer.height, "the picture is ", source.width, " x ",
        source.height, " pixels, the fit was made on ", layer.width, " x ", layer.height);
  const cv::Size size(layer.width, layer.height);
  cv::Mat not_drawn(size, CV_8U, cv::Scalar(255)), not_face(size, CV_8U), distance, labels, to_face;
  double largest = 0;
  for (std::size_t i = 0; i < layer.alpha.size(); ++i) {
    not_face.data[i] = mask.pixels[i] > 127 ? 0 : 255;
    if (layer.alpha[i] < least_alpha) continue;
    not_drawn.data[i] = 0;
    largest = std::max(largest, static_cast<double>(std::hypot(layer.shift_px[i][0], layer.shift_px[i][1])));
  }
  // A hundredth of a pixel is no motion: a mouth at rest gives the picture back as it is.
  if (largest < 0.01) return source;
  cv::distanceTransform(not_drawn, distance, labels, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
  cv::distanceTransform(not_face, to_face, cv::DIST_L2, cv::DIST_MASK_5);
  std::vector<cv::Vec2f> motion;  // of every label
  for (std::size_t i = 0; i < layer.alpha.size(); ++i) {
    if (not_drawn.data[i] != 0) continue;
    const auto label = static_cast<std::size_t>(reinterpret_cast<const int*>(labels.data)[i]);
    if (motion.size() <= label) motion.resize(label + 1);
    motion[label] = {layer.shift_px[i][0] / layer.alpha[i], layer.shift_px[i][1] / layer.alpha[i]};
  }
  cv::Mat field(size, CV_32FC2), map(size, CV_32FC2), moved;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      field.at<cv::Vec2f>(y, x) = motion[static_cast<std::size_t>(labels.at<int>(y, x))];
  cv::GaussianBlur(field, field, {0, 0}, std::max(0.5, smooth_mm * scale));
  const double reach = std::max(reach_mm * scale, steepest * largest), rim = std::max(1.0, outside_mm * scale);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const auto share =
          static_cast<float>(fade(distance.at<float>(y, x) / reach) * fade(to_face.at<float>(y, x) / rim));
      const cv::Vec2f& by = field.at<cv::Vec2f>(y, x);
      map.at<cv::Vec2f>(y, x) = {static_cast<float>(x) - share * by[0], static_cast<float>(y) - share * by[1]};
    }
  const cv::Mat from(size, CV_8UC3, const_cast<std::uint8_t*>(source.pixels.data()));
  cv::remap(from, moved, map, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  Image result = source;
  std::copy(moved.data, moved.data + result.pixels.size(), result.pixels.begin());
  return result;
}

}  // namespace face::texture
