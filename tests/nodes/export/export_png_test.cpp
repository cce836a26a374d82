// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_png.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "nodes/base/random.h"
#include "tests/support/expect_throw_text.h"

namespace face::exports {
namespace {

Image noise(int width, int height, int channels) {
  Image image{width, height, channels, {}};
  Random random(3);
  for (int i = 0; i < width * height * channels; ++i)
    image.pixels.push_back(static_cast<std::uint8_t>(random.bits() & 255));
  return image;
}

TEST(ExportPng, KeepsEveryPixel) {
  for (const int channels : {1, 3, 4}) {
    const Image image = noise(17, 5, channels);
    const engine::File file = export_png(image);
    EXPECT_EQ(file.suffix(), ".png");
    const std::vector<std::uint8_t> bytes(file.bytes().begin(), file.bytes().end());
    const cv::Mat read = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(read.cols, 17);
    ASSERT_EQ(read.rows, 5);
    ASSERT_EQ(read.channels(), channels);
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 17; ++x)
        for (int c = 0; c < channels; ++c) {
          const int stored = channels >= 3 && c < 3 ? 2 - c : c;  // OpenCV's order is BGR
          ASSERT_EQ(int{read.ptr<std::uint8_t>(y)[x * channels + stored]},
                    int{image.pixels[static_cast<std::size_t>((y * 17 + x) * channels + c)]})
              << channels << " channels at " << x << ", " << y << ", " << c;
        }
  }
}

TEST(ExportPng, GivesTheSameBytesTwice) {
  EXPECT_EQ(export_png(noise(40, 30, 3)).bytes(), export_png(noise(40, 30, 3)).bytes());
}

TEST(ExportPng, RejectsWhatIsNoImage) {
  EXPECT_THROW_TEXT(export_png(Image{}), "the image is 0 x 0 pixels, expected at least 1 x 1");
  EXPECT_THROW_TEXT(export_png(Image{2, 2, 2, std::vector<std::uint8_t>(8)}),
                    "the image has 2 channels, expected 1, 3 or 4");
  EXPECT_THROW_TEXT(export_png(Image{2, 2, 3, std::vector<std::uint8_t>(11)}),
                    "the image has 11 bytes, expected 12 for 2 x 2 x 3");
}

}  // namespace
}  // namespace face::exports
