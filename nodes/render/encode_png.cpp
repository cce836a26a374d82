// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/encode_png.h"

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "nodes/base/check.h"

namespace face::render {

std::string encode_png(const Image& image) {
  check(image.width > 0 && image.height > 0, "the image is ", image.width, " x ", image.height,
        " pixels, expected at least 1 x 1");
  check(image.channels == 1 || image.channels == 3 || image.channels == 4, "the image has ", image.channels,
        " channels, expected 1, 3 or 4");
  const std::size_t expected = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                               static_cast<std::size_t>(image.channels);
  check(image.pixels.size() == expected, "the image has ", image.pixels.size(), " bytes, expected ", expected, " for ",
        image.width, " x ", image.height, " x ", image.channels);
  const cv::Mat view(image.height, image.width, CV_8UC(image.channels), const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat bgr;  // not a second header of the view: the conversion would write into the caller's image
  if (image.channels == 1) bgr = view;
  if (image.channels == 3) cv::cvtColor(view, bgr, cv::COLOR_RGB2BGR);
  if (image.channels == 4) cv::cvtColor(view, bgr, cv::COLOR_RGBA2BGRA);
  std::vector<std::uint8_t> bytes;
  check(cv::imencode(".png", bgr, bytes, {cv::IMWRITE_PNG_COMPRESSION, 6}), "the image could not be written as PNG");
  return {bytes.begin(), bytes.end()};
}

}  // namespace face::render
