// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/png16.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "nodes/base/check.h"

namespace face::exports {

std::string encode_png16(const std::vector<std::uint16_t>& values, int width, int height) {
  check(width > 0 && height > 0 && values.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
        "there are ", values.size(), " values, expected ", width, " x ", height, ", at least 1 x 1");
  const cv::Mat view(height, width, CV_16UC1, const_cast<std::uint16_t*>(values.data()));
  std::vector<std::uint8_t> bytes;
  check(cv::imencode(".png", view, bytes, {cv::IMWRITE_PNG_COMPRESSION, 6}), "the depth could not be written as PNG");
  return {bytes.begin(), bytes.end()};
}

}  // namespace face::exports
