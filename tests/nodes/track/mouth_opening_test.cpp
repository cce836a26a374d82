// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/mouth_opening.h"

#include <gtest/gtest.h>

#include "tests/nodes/track/drawn_mouth.h"
#include "tests/nodes/track/lips_in.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using test::DrawnMouth;

namespace {

double opening(const DrawnMouth& mouth) { return test::mouth_opening_in(mouth.image(), mouth.outer()); }

}  // namespace

TEST(MouthOpening, IsHowFarTheLipsAreApart) {
  constexpr double width_px = 80, hollow_unlike_lips = 1 - 25.0 / 75;  // its redness, and theirs
  const double shut = opening({});
  for (const double half_px : {1.0, 2.0, 4.0, 7.0}) {
    const double gap = (2 * half_px - 1) / width_px * hollow_unlike_lips;  // so many rows are drawn
    EXPECT_NEAR(opening({half_px, half_px}) - shut, gap, 0.3 * gap) << half_px;
  }
}

TEST(MouthOpening, OfTeethIsThatOfAHollow) {
  EXPECT_NEAR(opening({5, 5, test::tooth}) / opening({5, 5, test::hollow}), 1, 0.3);
}

TEST(MouthOpening, OfLipsAloneIsSmall) { EXPECT_LE(opening({}), 0.01); }

TEST(MouthOpening, OfLipsThatAreGlossyOrInTheShadeIsSmall) {
  const auto lit = [](const DrawnMouth& mouth) { return test::mouth_opening_in(test::glossy(mouth), mouth.outer()); };
  EXPECT_LE(lit({}), 0.01);
  EXPECT_GE(lit({4, 4, test::tooth}), 0.04);
  EXPECT_GE(lit({4, 4, test::hollow}), 0.04);
}

TEST(MouthOpening, ChangesLittleInHalfTheLightAndInAFlatPicture) {
  const DrawnMouth mouth{4, 6};
  Image dim = mouth.image(), flat = dim;
  for (std::uint8_t& value : dim.pixels) value = static_cast<std::uint8_t>(value * 6 / 10);
  for (std::uint8_t& value : flat.pixels) value = static_cast<std::uint8_t>(80 + value * 4 / 10);
  EXPECT_NEAR(test::mouth_opening_in(dim, mouth.outer()) / opening(mouth), 1, 0.1);
  EXPECT_NEAR(test::mouth_opening_in(flat, mouth.outer()) / opening(mouth), 1, 0.1);
}

TEST(MouthOpening, OfAGreyPictureGrowsWithWhatShowsBetweenTheLips) {
  const auto grey = [](const DrawnMouth& mouth) {
    Image image = mouth.image();
    for (std::size_t i = 0; i < image.pixels.size(); i += 3)
      image.pixels[i + 1] = image.pixels[i + 2] = image.pixels[i];
    return test::mouth_opening_in(image, mouth.outer());
  };
  EXPECT_GE(grey({2, 2}), 1.3 * grey({}));
  EXPECT_GE(grey({4, 4}), 1.5 * grey({2, 2}));
}

TEST(MouthOpening, IsNotKnownWhereAPointIsLost) {
  const DrawnMouth mouth{4, 6};
  for (const std::size_t lip : {0, 3, 6, 9}) {
    Landmarks outer = mouth.outer();
    outer.points[lip].valid = false;
    EXPECT_EQ(test::mouth_opening_in(mouth.image(), outer), -1) << lip;
  }
}

TEST(MouthOpening, WantsTheLipsOfTheLayout) {
  const DrawnMouth mouth;
  Landmarks outer = mouth.outer();
  outer.points.erase(outer.points.begin() + 3);
  EXPECT_THROW_TEXT(test::mouth_opening_in(mouth.image(), outer),
                    "there is no landmark lip_3: the lips' points are lip_0 to lip_11");
}
