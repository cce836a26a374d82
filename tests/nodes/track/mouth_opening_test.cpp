// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/mouth_opening.h"

#include <gtest/gtest.h>

#include "tests/nodes/track/drawn_mouth.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using test::DrawnMouth;

namespace {

double opening(const DrawnMouth& mouth) { return track::mouth_opening(mouth.image(), mouth.outer()); }

}  // namespace

TEST(MouthOpening, GrowsWithWhatShowsBetweenTheLips) {
  double last = opening({});
  for (const double half_px : {1.0, 2.0, 4.0, 7.0}) {
    const double next = opening({half_px, half_px});
    EXPECT_GT(next, last + 0.02) << half_px;
    last = next;
  }
}

TEST(MouthOpening, OfTeethIsNoSmallerThanOfAHollow) {
  EXPECT_GE(opening({5, 5, test::tooth}), 1.5 * opening({}));
  EXPECT_GE(opening({5, 5, test::hollow}), 1.5 * opening({}));
}

TEST(MouthOpening, OfLipsAloneIsSmall) { EXPECT_LE(opening({}), 0.1); }

TEST(MouthOpening, ChangesLittleInHalfTheLight) {
  const DrawnMouth mouth{4, 6};
  Image dim = mouth.image();
  for (std::uint8_t& value : dim.pixels) value = static_cast<std::uint8_t>(value * 6 / 10);
  EXPECT_NEAR(track::mouth_opening(dim, mouth.outer()) / opening(mouth), 1, 0.1);
}

TEST(MouthOpening, IsNotKnownWhereAPointIsLost) {
  const DrawnMouth mouth{4, 6};
  for (const std::size_t lip : {0, 3, 6, 9}) {
    Landmarks outer = mouth.outer();
    outer.points[lip].valid = false;
    EXPECT_EQ(track::mouth_opening(mouth.image(), outer), -1) << lip;
  }
}

TEST(MouthOpening, WantsTheLipsOfTheLayout) {
  const DrawnMouth mouth;
  Landmarks outer = mouth.outer();
  outer.points.erase(outer.points.begin() + 3);
  EXPECT_THROW_TEXT(track::mouth_opening(mouth.image(), outer),
                    "there is no landmark lip_3: the lips' points are lip_0 to lip_11");
}
