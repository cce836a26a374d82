// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/normalise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/sample_image.h"
#include "nodes/mmm/crop.h"
#include "nodes/mmm/head_mask.h"
#include "nodes/mmm/warp_perspective.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

Image textured(int width, int height) {
  Image image{width, height, 3, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        image.pixels.push_back(to_byte(128 + 40 * std::sin(0.21 * x + 0.1 * y + c) * std::cos(0.17 * y - 0.05 * x) +
                                       30 * std::sin(0.07 * x * 1.3 - 0.11 * y)));
  return image;
}

Matrix small_motion() { return {3, 3, {1.004, 0.008, 2.2, -0.008, 1.004, -1.4, 1e-5, 0, 1}}; }

TEST(Normalise, FindsHowAPlaneHasMovedThroughAMouthThatMovesOtherwise) {
  const Image reference = textured(160, 120);
  // frame(H x) = reference(x), so that frame(p) = reference(H^-1 p).
  Image frame = warp_perspective(reference, small_motion(), {.inverse = true});
  for (int y = 84; y < 112; ++y)
    for (int x = 60 * 3; x < 100 * 3; ++x) frame.pixels[static_cast<std::size_t>(y * 480 + x)] = 30;
  HeadMaskOptions boxes;
  boxes.head = {0.05, 0.05, 0.95, 0.95};
  boxes.eyes = {0.3, 0.3, 0.7, 0.4};
  boxes.mouth = {0.35, 0.65, 0.65, 1};
  const Image mask = head_mask(reference, nullptr, boxes);
  for (const bool half : {false, true}) {
    NormaliseOptions options;
    options.half_size = half;
    const FitPerspectiveResult fit = normalise(reference, frame, &mask, options);
    ASSERT_TRUE(fit.solved);
    for (const auto& [x, y] : {std::pair{30.0, 40.0}, {120.0, 40.0}, {80.0, 70.0}}) {
      const auto found = map_point(fit.target_from_reference, x, y), true_place = map_point(small_motion(), x, y);
      // The issue asks for 0.3 px.
      EXPECT_LT(std::hypot(found[0] - true_place[0], found[1] - true_place[1]), 0.15) << "half size " << half;
    }
  }
}

TEST(Normalise, OfTheSamePictureIsTheIdentity) {
  const Image reference = textured(96, 72);
  const FitPerspectiveResult fit = normalise(reference, reference, nullptr);
  ASSERT_TRUE(fit.solved);
  const auto p = map_point(fit.target_from_reference, 90, 5);
  EXPECT_NEAR(p[0], 90, 1e-3);
  EXPECT_NEAR(p[1], 5, 1e-3);
}

TEST(Normalise, SaysThatAnEmptyMaskSolvesNothing) {
  const Image reference = textured(64, 48), mask{64, 48, 1, std::vector<std::uint8_t>(64 * 48, 0)};
  EXPECT_FALSE(normalise(reference, reference, &mask).solved);
}

TEST(Normalise, RejectsAFrameOfAnotherSize) {
  EXPECT_THROW_TEXT(normalise(textured(64, 48), textured(64, 47), nullptr),
                    "frame is 64 x 47 pixels, reference is 64 x 48");
}

TEST(WarpPerspective, TheInverseBringsTheHeadBack) {
  const Image image = textured(96, 72);
  const Image back = warp_perspective(warp_perspective(image, small_motion()), small_motion(), {.inverse = true});
  double sum = 0;
  for (int y = 10; y < 62; ++y)
    for (int x = 10; x < 86; ++x) {
      const auto at = static_cast<std::size_t>((y * 96 + x) * 3);
      sum += std::pow(image.pixels[at] - back.pixels[at], 2);
    }
  // Two interpolations and two roundings.
  EXPECT_LT(std::sqrt(sum / (52 * 76)), 1);
}

TEST(WarpPerspective, RejectsAPerspectiveThatCannotBeInverted) {
  EXPECT_THROW_TEXT(warp_perspective(textured(8, 8), Matrix{3, 3, std::vector<double>(9, 0)}),
                    "perspective has the determinant 0, expected one that can be inverted");
  EXPECT_THROW_TEXT(warp_perspective(textured(8, 8), Matrix{}), "perspective is 0 x 0, expected 3 x 3");
}

TEST(HeadMask, LeavesEyesAndMouthOut) {
  HeadMaskOptions boxes;
  boxes.head = {0, 0, 1, 1};
  boxes.eyes = {0.2, 0.2, 0.8, 0.4};
  boxes.mouth = {0.3, 0.7, 0.7, 0.9};
  const Image mask = head_mask(textured(100, 100), nullptr, boxes);
  const auto on = [&](int x, int y) { return mask.pixels[static_cast<std::size_t>(y * 100 + x)] == 255; };
  EXPECT_TRUE(on(50, 55));
  EXPECT_FALSE(on(50, 30));
  EXPECT_FALSE(on(50, 80));
  EXPECT_FALSE(on(2, 2));
}

TEST(HeadMask, NamesTheBoxAndTheLandmarkThatIsWrong) {
  HeadMaskOptions boxes;
  boxes.eyes = {0.5, 0.2, 0.4, 0.4};
  EXPECT_THROW_TEXT(head_mask(textured(8, 8), nullptr, boxes),
                    "eyes is from 0.5, 0.2 to 0.4, 0.4, expected left < right and top < bottom");
  const Landmarks few{{{"00", 1, 1, true}}};
  EXPECT_THROW_TEXT(head_mask(textured(8, 8), &few), "landmark 39 is missing, expected the 68 of Multi-PIE");
}

TEST(Crop, RejectsAPartThatIsNotThere) {
  EXPECT_THROW_TEXT(crop(textured(8, 8), nullptr, {4, 0, 5, 2}),
                    "the part of 5 x 2 pixels at 4, 0 does not lie within the picture of 8 x 8");
  EXPECT_EQ(crop(textured(8, 8), nullptr, {7, 7, 1, 1}).pixels.size(), 3u);
}

}  // namespace
}  // namespace face::mmm
