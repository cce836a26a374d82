// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/sample_image.h"

#include <gtest/gtest.h>

namespace face {
namespace {

// A parabola along x, a line along y: the cubic of Keys has both exactly.
Image curved(int channels) {
  Image image{12, 8, channels, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < channels; ++c) image.pixels.push_back(static_cast<std::uint8_t>(x * x + 3 * y + 10 * c));
  return image;
}

TEST(SampleImage, HasParabolasExactlyBetweenPixels) {
  for (const int channels : {1, 3}) {
    const Image image = curved(channels);
    for (const double x : {2.0, 3.25, 7.9})
      for (const double y : {1.0, 2.5, 4.75}) {
        float values[3];
        sample_image(image, x, y, values);
        for (int c = 0; c < channels; ++c) EXPECT_NEAR(values[c], x * x + 3 * y + 10 * c, 1e-4);
      }
  }
}

TEST(SampleImage, GoesOnWithTheEdgeOutsideThePicture) {
  const Image image = curved(1);
  float outside, edge;
  sample_image(image, -5, 3, &outside);
  sample_image(image, 0, 3, &edge);
  EXPECT_EQ(outside, edge);
  sample_image(image, 40, 90, &outside);
  EXPECT_EQ(outside, static_cast<float>(image.pixels.back()));
}

TEST(SampleImage, RoundsToBytesAndHoldsThem) {
  EXPECT_EQ(to_byte(-3.0), 0);
  EXPECT_EQ(to_byte(17.5), 18);
  EXPECT_EQ(to_byte(300.0), 255);
}

}  // namespace
}  // namespace face
