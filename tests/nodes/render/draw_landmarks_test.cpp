// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/draw_landmarks.h"

#include <gtest/gtest.h>

#include <cstddef>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::render;

// How many pixels are drawn on, a share of the picture.
double drawn_share(int size) {
  const auto pixels = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  const Image grey{size, size, 1, std::vector<std::uint8_t>(pixels, 128)};
  const Image drawn = draw_landmarks(grey, {{{"nose_tip", 0.5 * size, 0.5 * size}}});
  std::size_t changed = 0;
  for (std::size_t i = 0; i < pixels; ++i) changed += drawn.pixels[3 * i] != 128 ? 1 : 0;
  return static_cast<double>(changed) / static_cast<double>(pixels);
}

}  // namespace

// Of a film of 1920 x 1080 beside a head no dot was seen.
TEST(DrawLandmarks, DotsAreSeenInLargePictures) {
  EXPECT_GT(drawn_share(640), 0);
  EXPECT_GT(drawn_share(2560), 0.5 * drawn_share(640));  // a sixteenth before; the rim is as wide in either
}

TEST(DrawLandmarks, LeavesOutPointsOutsideThePicture) {
  const Image grey{8, 8, 3, std::vector<std::uint8_t>(192, 128)};
  EXPECT_EQ(draw_landmarks(grey, {{{"chin", 50, 50}}}).pixels, grey.pixels);
}

TEST(DrawLandmarks, RejectsARadiusOfNothing) {
  EXPECT_THROW_TEXT(draw_landmarks({8, 8, 3, std::vector<std::uint8_t>(192)}, {}, {.radius_px = 0}),
                    "radius_px is 0, expected more than 0");
}
