// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/place_beside.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::render;

Image plain(int width, int height, int channels, std::uint8_t value) {
  return {width, height, channels,
          std::vector<std::uint8_t>(static_cast<std::size_t>(width * height * channels), value)};
}

}  // namespace

TEST(PlaceBeside, BringsBothToOneHeight) {
  const Image both = place_beside(plain(30, 20, 3, 90), plain(8, 8, 1, 200), {.height_px = 10});
  EXPECT_EQ(both.height, 10);
  EXPECT_EQ(both.width, 26);  // 15 + 10, made even
  EXPECT_EQ(both.pixels[0], 90);
  EXPECT_EQ(both.pixels[3 * 14 + 2], 90);
  EXPECT_EQ(both.pixels[3 * 15], 200);
  EXPECT_EQ(both.pixels[3 * 24 + 1], 200);
  EXPECT_EQ(both.pixels[3 * 25], 0);
}

TEST(PlaceBeside, RejectsNoPictureAndAnOddHeight) {
  EXPECT_THROW_TEXT(place_beside({}, plain(2, 2, 3, 0)), "a picture is 0 x 0 pixels, expected at least 1 x 1");
  EXPECT_THROW_TEXT(place_beside(plain(2, 2, 3, 0), plain(2, 2, 3, 0), {.height_px = 7}),
                    "height_px is 7, expected an even number");
}
