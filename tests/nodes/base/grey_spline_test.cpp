// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/grey_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "nodes/base/sample_image.h"

namespace face {
namespace {

// A bright disc on dark skin as a lens of half a pixel shows it, its middle moved by parts of a pixel.
Image disc(double shift, int channels = 1) {
  Image image{25, 21, channels, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double r = std::hypot(x - 12 - shift, y - 10 - shift);
      const double grey = 75 + 165 * 0.5 * std::erfc((r - 3) / (0.7 * std::sqrt(2.0)));
      for (int c = 0; c < channels; ++c) image.pixels.push_back(static_cast<std::uint8_t>(std::lround(grey)));
    }
  return image;
}

TEST(GreySpline, GoesThroughThePixels) {
  for (const int channels : {1, 3}) {
    const Image image = disc(0.3, channels);
    const GreySpline spline(image);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        EXPECT_NEAR(spline.at(x, y), image.pixels[static_cast<std::size_t>((y * image.width + x) * channels)], 1e-9);
  }
}

TEST(GreySpline, HasParabolasExactlyBetweenPixels) {
  Image image{16, 40, 1, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.pixels.push_back(static_cast<std::uint8_t>(x * x + 20));
  // The mirrored ends, which are no parabola, are forgotten by 0.27 per pixel.
  EXPECT_NEAR(GreySpline(image).at(7.5, 20.25), 7.5 * 7.5 + 20, 0.01);
}

TEST(GreySpline, KeepsTheEdgesOfADiscThatTheCubicOfKeysWearsDown) {
  const Image still = disc(0), moved = disc(0.5);
  const GreySpline spline(still);
  double of_spline = 0, of_keys = 0;
  for (int y = 3; y < 18; ++y)
    for (int x = 3; x < 22; ++x) {
      const double seen = moved.pixels[static_cast<std::size_t>(y * moved.width + x)];
      float keys = 0;
      sample_image(still, x - 0.5, y - 0.5, &keys);
      of_spline += std::pow(spline.at(x - 0.5, y - 0.5) - seen, 2);
      of_keys += std::pow(static_cast<double>(keys) - seen, 2);
    }
  EXPECT_LT(of_spline, 0.4 * of_keys);  // 0.34
}

TEST(GreySpline, GoesOnWithTheEdgeOutsideThePicture) {
  const Image image = disc(0.3);
  const GreySpline spline(image);
  EXPECT_EQ(spline.at(-5, 3.5), spline.at(0, 3.5));
  EXPECT_EQ(spline.at(40, 90), spline.at(24, 20));
}

TEST(GreySpline, OfOnePixelIsItsGrey) { EXPECT_NEAR(GreySpline(Image{1, 1, 1, {90}}).at(3, -2), 90, 1e-9); }

}  // namespace
}  // namespace face
