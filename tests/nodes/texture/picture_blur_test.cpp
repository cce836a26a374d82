// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/picture_blur.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "nodes/base/random.h"
#include "tests/nodes/model/material.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::texture;

namespace {

constexpr int side = 96;

// A disk whose edge is a step, made unsharp by a Gaussian; with grain.
Image disk(double sigma_px, double grain) {
  Image image = test::blank(side, side, 0);
  Random random(7);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double inside = 30 - std::hypot(x - 47.6, y - 47.3);
      const double value =
          70 + 100 * 0.5 * (1 + std::erf(inside / (sigma_px * std::sqrt(2.0)))) + grain * random.normal();
      for (std::size_t c = 0; c < 3; ++c)
        image.pixels[static_cast<std::size_t>(3 * (y * side + x)) + c] = static_cast<std::uint8_t>(std::lround(value));
    }
  return image;
}

Image everywhere(std::uint8_t value) {
  Image mask = test::blank(side, side, 0);
  mask.channels = 1;
  mask.pixels.assign(side * side, value);
  return mask;
}

TEST(PictureBlur, IsTheStandardDeviationOfAnUnsharpEdge) {
  for (const double sigma_px : {0.6, 1.0, 1.5, 2.5})
    EXPECT_NEAR(picture_blur_px(disk(sigma_px, 0), everywhere(255)), sigma_px, 0.1 * sigma_px) << sigma_px;
}

TEST(PictureBlur, IsNotMisledByGrain) {
  for (const double sigma_px : {0.6, 1.0, 1.5})
    EXPECT_NEAR(picture_blur_px(disk(sigma_px, 2), everywhere(255)), sigma_px, 0.2 * sigma_px) << sigma_px;
}

TEST(PictureBlur, IsThatOfAPixelWhereThereIsNoEdge) {
  EXPECT_DOUBLE_EQ(picture_blur_px(test::blank(side, side, 120), everywhere(255)), 0.3);
  EXPECT_DOUBLE_EQ(picture_blur_px(disk(2, 0), everywhere(0)), 0.3);
}

TEST(PictureBlur, RejectsAMaskOfAnotherSize) {
  EXPECT_THROW_TEXT(picture_blur_px(test::blank(10, 20), everywhere(255)),
                    "the mask is 96 x 96 pixels, the picture 10 x 20");
}

}  // namespace
