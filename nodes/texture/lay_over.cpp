// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/lay_over.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "nodes/base/check.h"
#include "nodes/render/rgb_image.h"
#include "nodes/texture/follow_face.h"
#include "nodes/texture/picture_blur.h"

namespace face::texture {
namespace {

constexpr double revealed_mm = 5;           // width of a place where the face is no more, from which it is uncovered
constexpr double revealed_margin_mm = 1.5;  // by which it is widened: a fit is never exact
constexpr double of_pixel = 1.0 / 12;       // variance of a box as large as a pixel, which drawing has by itself

// What stands behind a drawn mouth and beside it, made as unsharp as the picture along the mouth's edge: a drawing is
// sharper than a photograph, above all one of a film. `shown`: 3 x 32 bits a pixel, the picture with the layer over it.
void soften_mouth(const FaceLayer& layer, double sigma_px, cv::Mat& shown) {
  const cv::Size size(layer.width, layer.height);
  const cv::Mat mouth(size, CV_32F, const_cast<float*>(layer.mouth.data()));
  const cv::Mat colour(size, CV_32FC3, const_cast<Vec3f*>(layer.mouth_colour.data()));
  const int reach = static_cast<int>(std::ceil(4 * sigma_px)) + 1;
  cv::Rect box;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      if (mouth.at<float>(y, x) > 0) box |= cv::Rect(x, y, 1, 1);
  if (box.empty()) return;
  box = cv::Rect(box.x - reach, box.y - reach, box.width + 2 * reach, box.height + 2 * reach) & cv::Rect({0, 0}, size);
  // What is beside the mouth, times how much of the pixel it is, goes on behind the mouth.
  cv::Mat beside = shown(box) - 255 * colour(box), beside_share = 1 - mouth(box), wide, wide_share, soft, soft_share;
  const double wide_px = std::max(1.0, 2 * sigma_px);
  cv::GaussianBlur(beside, wide, {0, 0}, wide_px);
  cv::GaussianBlur(beside_share, wide_share, {0, 0}, wide_px);
  cv::GaussianBlur(colour(box), soft, {0, 0}, sigma_px);
  cv::GaussianBlur(mouth(box), soft_share, {0, 0}, sigma_px);
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      const float inside = soft_share.at<float>(y, x), sure = beside_share.at<float>(y, x);
      if (inside < 1e-3f) continue;
      const float around = std::max(1e-4f, wide_share.at<float>(y, x));
      for (int c = 0; c < 3; ++c) {
        const float own = beside.at<cv::Vec3f>(y, x)[c] + (1 - sure) * wide.at<cv::Vec3f>(y, x)[c] / around;
        shown.at<cv::Vec3f>(y + box.y, x + box.x)[c] = 255 * soft.at<cv::Vec3f>(y, x)[c] + (1 - inside) * own;
      }
    }
}

}  // namespace

Image lay_over(const FaceLayer& layer, const Image& picture, const Image& background, const Image& mask, double scale) {
  const Image front = follow_face(layer, picture, mask, scale), back = render::rgb_image(background);
  check(back.width == layer.width && back.height == layer.height, "the background is ", back.width, " x ", back.height,
        " pixels, expected ", layer.width, " x ", layer.height);
  // Where a face was and is no more, by more than a thin line, which follow_face takes care of; widened by the margin.
  cv::Mat revealed(layer.height, layer.width, CV_8U), soft;
  for (std::size_t i = 0; i < layer.cover.size(); ++i)
    revealed.data[i] = mask.pixels[i] > 127 && layer.cover[i] < 0.5f ? 255 : 0;
  const int line = std::max(2, static_cast<int>(std::lround(revealed_mm * scale)));
  cv::morphologyEx(revealed, revealed, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_RECT, {line, line}));
  const int margin = std::max(1, static_cast<int>(std::lround(revealed_margin_mm * scale)));
  cv::dilate(revealed, revealed, cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * margin + 1, 2 * margin + 1}));
  cv::GaussianBlur(revealed, soft, {0, 0}, 0.7);
  cv::Mat laid(layer.height, layer.width, CV_32FC3);
  for (std::size_t i = 0; i < layer.alpha.size(); ++i) {
    const float kept = std::max(0.0f, layer.cover[i] - layer.alpha[i]), open = std::max(0.0f, 1 - layer.cover[i]);
    const float shown = open * static_cast<float>(soft.data[i]) / 255.0f;
    for (std::size_t c = 0; c < 3; ++c) {
      laid.ptr<float>()[3 * i + c] = 255.0f * layer.colour[i][c] + (kept + open - shown) * front.pixels[3 * i + c] +
                                     shown * back.pixels[3 * i + c];
    }
  }
  // Lashes and hair are finer than edges, and look sharper: the lower face alone is asked.
  Image drawn = mask;
  for (std::size_t i = 0; i < layer.alpha.size(); ++i) drawn.pixels[i] = layer.alpha[i] > 0.5f ? mask.pixels[i] : 0;
  const double blur_px = picture_blur_px(picture, drawn);
  soften_mouth(layer, std::sqrt(std::max(0.01, blur_px * blur_px - of_pixel)), laid);
  Image result = front;
  const float* const values = laid.ptr<float>();
  for (std::size_t i = 0; i < result.pixels.size(); ++i)
    result.pixels[i] = static_cast<std::uint8_t>(std::clamp(values[i] + 0.5f, 0.0f, 255.0f));
  return result;
}

}  // namespace face::texture
