// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/lip_colours.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/luma.h"
#include "nodes/track/inner_lips.h"
#include "nodes/track/mouth_opening.h"
#include "tests/nodes/track/drawn_mouth.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using test::DrawnMouth;

namespace {

std::array<double, 3> told(const test::Colour& colour) {
  const auto [red, green, blue] = colour;
  return {std::log((red + 8.0) / (green + 8.0)), std::log((blue + 8.0) / (green + 8.0)),
          luma<double>(red, green, blue) / 255};
}

}  // namespace

TEST(LipColours, AreThoseOfThreeLinesFromAbove) {
  const DrawnMouth mouth{8, 8};
  const track::LipColoursResult seen = track::lip_colours(mouth.image(), mouth.outer());
  ASSERT_EQ(seen.colours.rows, 192u);
  ASSERT_EQ(seen.colours.columns, 3u);
  for (std::size_t line = 0; line < 3; ++line)
    for (const auto& [sample, colour] :
         {std::pair{10, test::upper_lip}, {28, test::hollow}, {36, test::hollow}, {54, test::lower_lip}})
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(seen.colours.at(64 * line + static_cast<std::size_t>(sample), c), told(colour)[c], 1e-4)
            << line << " " << sample;
  EXPECT_EQ(seen.contrast.values, std::vector<double>(3, 1)) << "nobody knows where the eyes are";
}

TEST(LipColours, AreInTheLightOfTheStart) {
  const DrawnMouth mouth{5, 9};
  Image lit = mouth.image();
  for (std::uint8_t& value : lit.pixels) value = static_cast<std::uint8_t>(value / 2 + 20);
  const Matrix light{3, 2, {2, -40, 2, -40, 2, -40}};
  const track::LipColoursResult plain = track::lip_colours(mouth.image(), mouth.outer()),
                                taken_back = track::lip_colours(lit, mouth.outer(), &light);
  for (std::size_t i = 0; i < plain.colours.values.size(); ++i)
    EXPECT_NEAR(taken_back.colours.values[i], plain.colours.values[i], 0.06) << i;  // of levels that were halved
}

TEST(LipColours, WantTheLipsOfTheLayout) {
  const DrawnMouth mouth;
  Landmarks outer = mouth.outer();
  outer.points.erase(outer.points.begin() + 10);
  EXPECT_THROW_TEXT(track::lip_colours(mouth.image(), outer),
                    "there is no landmark lip_10: the lips' points are lip_0 to lip_11");
}

TEST(LipColours, ThatSomebodyElseMadeAreRefused) {
  const DrawnMouth mouth{5, 9};
  track::LipColoursResult seen = track::lip_colours(mouth.image(), mouth.outer());
  const Matrix none{0, 3, {}};
  EXPECT_THROW_TEXT(track::mouth_opening(none, mouth.outer()),
                    "colours is 0 x 3, expected 192 x 3 as lip_colours gives it");
  EXPECT_THROW_TEXT(track::inner_lips(seen.colours, none, mouth.outer()),
                    "contrast is 0 x 3, expected 1 x 3 as lip_colours gives it");
  seen.contrast.values[1] = 0;
  EXPECT_THROW_TEXT(track::inner_lips(seen.colours, seen.contrast, mouth.outer()),
                    "contrast has 0, expected numbers above 0");
  seen.contrast.values[1] = 1;
  seen.colours.values[200] = NAN;
  EXPECT_THROW_TEXT(track::inner_lips(seen.colours, seen.contrast, mouth.outer()),
                    "colours has nan, expected finite numbers");
}
