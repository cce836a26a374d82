// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/reveal_background.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "nodes/base/check.h"
#include "nodes/render/rgb_image.h"

namespace face::texture {

Image reveal_background(const engine::Window<Image>& frame, const engine::Window<Image>& mask, const FaceFit& fit,
                        const ContinueBackgroundOptions& options) {
  check(frame.size() == mask.size(), "there are ", frame.size(), " frames and ", mask.size(), " masks around this one");
  Image result = continue_background(frame.centre(), mask.centre(), fit, options);
  const int margin = std::max(1, static_cast<int>(std::lround(2 * options.margin_mm * face_scale_px(fit))));
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * margin + 1, 2 * margin + 1});
  const auto widened = [&](const Image& image) {
    cv::Mat wide;
    const cv::Mat plain(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data()));
    cv::dilate(plain, wide, disc);
    return wide;
  };
  cv::Mat missing = widened(mask.centre());
  const std::size_t centre = frame.centre_index(), reach = std::max(centre, frame.size() - 1 - centre);
  for (std::size_t distance = 1; distance <= reach; ++distance)
    for (const int side : {-1, 1}) {
      const long index = static_cast<long>(centre) + side * static_cast<long>(distance);
      if (index < 0 || index >= static_cast<long>(frame.size())) continue;
      const auto i = static_cast<std::size_t>(index);
      check(mask[i].pixels.size() == mask.centre().pixels.size() && mask[i].width == mask.centre().width,
            "a mask around this one is ", mask[i].width, " x ", mask[i].height, ", expected ", mask.centre().width,
            " x ", mask.centre().height);
      const cv::Mat hidden = widened(mask[i]);
      const Image other = render::rgb_image(frame[i]);
      for (std::size_t p = 0; p < missing.total(); ++p) {
        if (missing.data[p] == 0 || hidden.data[p] != 0) continue;
        missing.data[p] = 0;
        for (std::size_t c = 0; c < 3; ++c) result.pixels[3 * p + c] = other.pixels[3 * p + c];
      }
    }
  return result;
}

}  // namespace face::texture
