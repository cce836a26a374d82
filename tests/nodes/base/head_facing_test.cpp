// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/head_facing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace {

using face::HeadFacing;
using Place = std::complex<double>;

constexpr double eyes_px = 50;
const Place at{200, 120};

double radians(double deg) { return deg * std::numbers::pi / 180; }

// Where a point of a head is seen that is so turned: x, y, depth in distances of the eyes.
Place seen(double x, double y, double depth, double nod_deg, double turn_deg, double tilt_deg) {
  const double n = radians(nod_deg), t = radians(turn_deg);
  const double down = std::cos(n) * y - std::sin(n) * depth, front = std::sin(n) * y + std::cos(n) * depth;
  return at + eyes_px * std::polar(1.0, radians(tilt_deg)) * Place(std::cos(t) * x + std::sin(t) * front, down);
}

HeadFacing facing_of(double nod_deg, double turn_deg, double tilt_deg) {
  const auto see = [&](double x, double y, double depth) { return seen(x, y, depth, nod_deg, turn_deg, tilt_deg); };
  return face::head_facing(
      see(-0.5, 0, 0), see(0.5, 0, 0),
      {face::nose_tip_mark(see(0, 0.77, 1.05), 0.77, 1.05), face::mouth_mark(see(0, 1.84, 0.27), 1.84, 0.27),
       face::chin_mark(see(0, 2.93, 0.34), 2.93, 0.34)});
}

double degrees(double rad) { return rad * 180 / std::numbers::pi; }

TEST(HeadFacing, OfAHeadThatLooksToTheCameraIsStraight) {
  const HeadFacing facing = facing_of(0, 0, 0);
  EXPECT_NEAR(facing.turn, 0, 1e-9);
  EXPECT_NEAR(facing.nod, 0, 1e-9);
  EXPECT_NEAR(std::abs(facing.unit_px - eyes_px), 0, 1e-9);
  EXPECT_NEAR(facing.depth_px({200, 158}, 52), 52, 1e-9);
}

TEST(HeadFacing, TellsATurnWhateverTheTilt) {
  for (const double turn_deg : {-18.0, 6.0, 18.0})
    for (const double tilt_deg : {-10.0, 0.0, 25.0}) {
      const HeadFacing facing = facing_of(0, turn_deg, tilt_deg);
      EXPECT_NEAR(degrees(facing.turn), turn_deg, 0.06 * std::abs(turn_deg)) << turn_deg << " " << tilt_deg;
      EXPECT_NEAR(std::abs(facing.unit_px), eyes_px, 1);
    }
}

// A long nose looks like a nod.
TEST(HeadFacing, BelievesAboutHalfOfANod) {
  for (const double nod_deg : {-8.0, 8.0}) {
    const HeadFacing facing = facing_of(nod_deg, 0, 0);
    EXPECT_GT(degrees(facing.nod) / nod_deg, 0.4);
    EXPECT_LT(degrees(facing.nod) / nod_deg, 0.8);
  }
}

TEST(HeadFacing, OfATurnedHeadHasTheEyeThatIsNearerInFront) {
  HeadFacing facing = facing_of(0, 18, 10);
  facing.turn = radians(18), facing.nod = 0;
  const double nearer = facing.depth_px(seen(-0.5, 0, 0, 0, 18, 10), 0);
  EXPECT_NEAR(nearer, 0.5 * eyes_px * std::sin(radians(18)), 1e-9);
  EXPECT_NEAR(facing.depth_px(seen(0.5, 0, 0, 0, 18, 10), 0), -nearer, 1e-9);
  // As deep as the rotation takes it.
  EXPECT_NEAR(facing.depth_px(seen(0, 0.77, 1.05, 0, 18, 10), 1.05 * eyes_px), 1.05 * eyes_px * std::cos(radians(18)),
              1e-9);
}

TEST(HeadFacing, DoesNotChangeWithTheSizeOfThePicture) {
  const auto facing_at = [](double times) {
    const auto see = [&](double x, double y, double depth) { return times * seen(x, y, depth, 5, 12, 0); };
    return face::head_facing(see(-0.5, 0, 0), see(0.5, 0, 0), {face::nose_tip_mark(see(0, 0.77, 1.05), 0.77, 1.05)});
  };
  const HeadFacing small = facing_at(1), large = facing_at(1000);
  EXPECT_NEAR(large.turn, small.turn, 1e-12);
  EXPECT_NEAR(large.nod, small.nod, 1e-12);
  EXPECT_NEAR(std::abs(large.unit_px), 1000 * std::abs(small.unit_px), 1e-6);
}

TEST(HeadFacing, WithoutMarksOrWithEyesInOnePlaceIsStraight) {
  const HeadFacing facing = face::head_facing({0, 0}, {40, 30}, {});
  EXPECT_EQ(facing.turn, 0);
  EXPECT_EQ(facing.nod, 0);
  EXPECT_EQ(facing.unit_px, Place(40, 30));
  EXPECT_EQ(face::head_facing({5, 5}, {5, 5}, {face::nose_tip_mark({7, 9}, 0.8, 1)}).turn, 0);
}

}  // namespace
