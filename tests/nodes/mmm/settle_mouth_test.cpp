// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/settle_mouth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/find_landmark.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

// A mouth 80 px wide whose seam is in the middle of 320 x 240 pixels, lips and chin as parabolas; the lower lip and the
// chin have fallen by drop_px, the head is elsewhere by (x_px, y_px), and each lip is thinner by part_px.
struct Mouth {
  double drop_px = 0, x_px = 0, y_px = 0, part_px = 0;

  static double hump(double u) { return std::max(0.0, 1 - u * u); }
  // Where the edges are (the shut lips' seam is dark and 2 px high), px below the seam at rest, u from -1 to 1 over the
  // mouth's width.
  double upper(double u) const { return -14 * hump(u); }
  double inner(double u) const { return (drop_px + part_px) * hump(u); }
  double inner_upper(double u) const { return -part_px * hump(u); }
  double lower(double u) const { return (18 + drop_px) * hump(u); }
  double chin(double u) const { return 62 + 0.8 * drop_px - 9 * u * u; }

  Image image() const {
    Image image{320, 240, 3, {}};
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        std::array<double, 3> sum{};
        for (const double sub : {-0.375, -0.125, 0.125, 0.375}) {  // edges of lips are soft
          const double u = (x - x_px - 160) / 40, v = y + sub - y_px - 120;
          std::array<double, 3> colour{200, 150, 120};
          if (v > chin(u)) colour = {150, 105, 80};
          if (v > upper(u) && v < lower(u))
            colour = v < 0 ? std::array{150.0, 75.0, 70.0} : std::array{180.0, 95.0, 90.0};
          if (std::abs(u) < 1 && v > inner_upper(u) - 1 && v < inner(u) + 1) colour = {40, 15, 12};
          for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c] / 4;
        }
        for (const double value : sum) image.pixels.push_back(static_cast<std::uint8_t>(std::lround(value)));
      }
    return image;
  }

  Landmarks points() const {
    Landmarks out;
    const auto add = [&](int number, double u, double v) {
      out.points.push_back(
          {(number < 10 ? "0" : "") + std::to_string(number), 160 + 40 * u + x_px, 120 + v + y_px, true});
    };
    for (int i = 0; i < 5; ++i) add(6 + i, 0.4 * i - 0.8, chin(0.4 * i - 0.8));
    add(30, 0, -60), add(31, -0.4, -45), add(35, 0.4, -45), add(36, -1.5, -100), add(45, 1.5, -100);
    add(27, 0.2, -90);
    for (int i = 0; i <= 6; ++i) add(48 + i, i / 3.0 - 1, upper(i / 3.0 - 1));
    for (int i = 1; i < 6; ++i) add(54 + i, 1 - i / 3.0, lower(1 - i / 3.0));
    add(60, -0.95, 0), add(61, -1 / 3.0, 0), add(62, 0, 0), add(63, 1 / 3.0, 0), add(64, 0.95, 0);
    add(65, 1 / 3.0, inner(1 / 3.0)), add(66, 0, inner(0)), add(67, -1 / 3.0, inner(-1 / 3.0));
    return out;
  }
};

Landmark& point_of(Landmarks& points, const std::string& name) {
  return points.points.at(landmark_index(points, name));
}

double apart_px(const Landmarks& a, const Landmarks& b, const std::string& name) {
  const Landmark &p = *find_landmark(a, name), &q = *find_landmark(b, name);
  return std::hypot(p.x_px - q.x_px, p.y_px - q.y_px);
}

const Mouth shut, open{.drop_px = 16};

Landmarks settled(const Mouth& mouth, const Landmarks& followed) {
  return settle_mouth(shut.image(), shut.points(), mouth.image(), followed, nullptr);
}

TEST(SettleMouth, BringsBackPointsThatSlidAlongTheLowerLip) {
  Landmarks followed = open.points();
  for (const int i : {56, 57, 58}) {
    Landmark& point = point_of(followed, std::to_string(i));
    const double u = (point.x_px - 160 - 6) / 40;
    point.x_px -= 6, point.y_px = 120 + open.lower(u);
  }
  const Landmarks found = settled(open, followed);
  for (const char* name : {"56", "57", "58"}) EXPECT_LT(apart_px(found, open.points(), name), 2) << name;
}

TEST(SettleMouth, BringsBackAChinThatFollowedTheLight) {
  Landmarks followed = open.points();
  for (const char* name : {"07", "08", "09"}) point_of(followed, name).x_px -= 6;
  const Landmarks found = settled(open, followed);
  for (const char* name : {"07", "08", "09"}) EXPECT_LT(apart_px(found, open.points(), name), 2) << name;
}

TEST(SettleMouth, FindsTheInnerLipsThatFlowTookIntoTheHollow) {
  Landmarks followed = open.points();
  for (const char* name : {"61", "62", "63"}) point_of(followed, name).y_px += 7;
  for (const char* name : {"65", "66", "67"}) point_of(followed, name).y_px -= 5;
  const Landmarks found = settled(open, followed);
  for (const char* name : {"61", "62", "63", "65", "66", "67"})
    EXPECT_LT(apart_px(found, open.points(), name), 1.5) << name;
}

TEST(SettleMouth, FindsInnerLipsThatPartWithoutTheOuterOnes) {
  const Mouth thin{.drop_px = 4, .part_px = 4};
  Landmarks truth = thin.points();
  for (const auto& [name, u] : {std::pair{"61", -1 / 3.0}, {"62", 0.0}, {"63", 1 / 3.0}})
    point_of(truth, name).y_px = 120 + thin.inner_upper(u);
  const Landmarks found = settled(thin, Mouth{.drop_px = 4}.points());
  for (const char* name : {"61", "62", "63", "65", "66", "67"}) EXPECT_LT(apart_px(found, truth, name), 1.5) << name;
}

TEST(SettleMouth, FindsALowerLipThatFlowHasLostInTheHollow) {
  const Mouth wide{.drop_px = 34};
  Landmarks followed = wide.points();
  for (int i = 55; i <= 59; ++i) point_of(followed, std::to_string(i)).y_px -= 20;
  const Landmarks found = settled(wide, followed);
  for (int i = 55; i <= 59; ++i) EXPECT_LT(apart_px(found, wide.points(), std::to_string(i)), 2) << i;
}

TEST(SettleMouth, LeavesWhatIsRightNearWhereItIs) {
  for (const Mouth& mouth : {shut, open, Mouth{.drop_px = 8, .x_px = 6, .y_px = -4}}) {
    const Landmarks found = settled(mouth, mouth.points());
    for (const Landmark& point : mouth.points().points)
      EXPECT_LT(apart_px(found, mouth.points(), point.name), 1.5) << point.name << " at " << mouth.drop_px;
  }
}

TEST(SettleMouth, GoesWithTheHead) {
  const Mouth here{.drop_px = 12}, there{.drop_px = 12, .x_px = 9, .y_px = 5};
  const Landmarks a = settled(here, here.points()), b = settled(there, there.points());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_NEAR(b.points[i].x_px - a.points[i].x_px, 9, 0.01) << a.points[i].name;
    EXPECT_NEAR(b.points[i].y_px - a.points[i].y_px, 5, 0.01) << a.points[i].name;
  }
}

TEST(SettleMouth, ALipThatWasPutElsewhereOnTheFirstFrameStaysThatFarAway) {
  Landmarks start = shut.points(), followed = shut.points();
  point_of(start, "57").x_px += 3, point_of(followed, "57").x_px += 3;
  const Landmarks found = settle_mouth(shut.image(), start, shut.image(), followed, nullptr);
  EXPECT_NEAR(find_landmark(found, "57")->x_px, 163, 0.5);
}

TEST(SettleMouth, TouchesNoOtherPoint) {
  const Landmarks followed = open.points(), found = settled(open, followed);
  for (const char* name : {"27", "30", "31", "35", "36", "45"}) EXPECT_EQ(apart_px(found, followed, name), 0) << name;
}

TEST(SettleMouth, DoesNothingWhereAPointOfTheOuterLipsIsNotSeen) {
  Landmarks followed = open.points();
  point_of(followed, "08").x_px -= 6;
  point_of(followed, "53").valid = false;
  const Landmarks found = settled(open, followed);
  for (const Landmark& point : followed.points) EXPECT_EQ(apart_px(found, followed, point.name), 0) << point.name;
}

TEST(SettleMouth, SettlesLipsWithoutChinAndInnerPoints) {
  Landmarks start = shut.points(), followed = open.points();
  std::erase_if(start.points, [](const Landmark& p) { return p.name < "11" || p.name >= "60"; });
  for (const char* name : {"56", "57", "58"}) point_of(followed, name).x_px -= 5;
  const Landmarks found = settle_mouth(shut.image(), start, open.image(), followed, nullptr);
  for (const char* name : {"56", "57", "58"}) EXPECT_LT(apart_px(found, open.points(), name), 2) << name;
  EXPECT_EQ(apart_px(found, followed, "08"), 0);
}

TEST(SettleMouth, RejectsAnotherNumberOfDepthsAndAFrameOfAnotherSize) {
  const Matrix depths{3, 1, {0, 0, 0}};
  EXPECT_THROW_TEXT(settle_mouth(shut.image(), shut.points(), open.image(), open.points(), &depths),
                    "depths_px has 3 numbers, start has 31 points");
  EXPECT_THROW_TEXT(
      settle_mouth(Image{8, 8, 3, std::vector<std::uint8_t>(192)}, shut.points(), open.image(), open.points(), nullptr),
      "the image is 320 x 240 pixels, reference is 8 x 8");
}

}  // namespace
}  // namespace face::mmm
