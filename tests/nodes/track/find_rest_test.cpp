// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/find_rest.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::track;

Landmarks mouth(double height) {
  Landmarks points;
  for (int i = 0; i < 12; ++i) {
    const double y = i == 0 || i == 6 ? 0 : (i < 6 ? -0.5 : 0.5) * height;
    points.points.push_back({"lip_" + std::to_string(i), static_cast<double>(i), y, true});
  }
  return points;
}

}  // namespace

TEST(FindRest, IsAShutMouthThoughTheClipBeginsWithAnOpenOne) {
  std::vector<Landmarks> frames{mouth(20)};
  for (int i = 0; i < 20; ++i) frames.push_back(mouth(8));
  for (int i = 0; i < 79; ++i) frames.push_back(mouth(12 + i % 5));
  frames.push_back(mouth(3));
  const Landmarks rest = find_rest(frames);
  EXPECT_NEAR(rest.points[3].y_px, -4, 1e-9);
  EXPECT_NEAR(rest.points[9].y_px, 4, 1e-9);
  EXPECT_NEAR(rest.points[9].x_px, 9, 1e-9);
}

TEST(FindRest, IsAMouthAtRestThoughBilabialsPressItThinner) {
  std::vector<Landmarks> frames;
  for (int word = 0; word < 10; ++word) {
    for (int i = 0; i < 3; ++i) frames.push_back(mouth(4));  // pressed, for a moment
    for (int i = 0; i < 7; ++i) frames.push_back(mouth(14 + 2 * (i % 3)));
  }
  for (int i = 0; i < 20; ++i) frames.push_back(mouth(8));
  EXPECT_NEAR(find_rest(frames).points[3].y_px, -4, 1e-9);
  FindRestOptions all;
  all.still_share = 1;
  EXPECT_GT(find_rest(frames, all).points[3].y_px, -3.9);
}

TEST(FindRest, KnowsTheNumbersOfMultiPie) {
  std::vector<Landmarks> named, numbered;
  for (int i = 0; i < 40; ++i) named.push_back(mouth(i == 0 ? 20 : 8 + i % 3));
  for (Landmarks frame : named) {
    for (std::size_t p = 0; p < 12; ++p) frame.points[p].name = std::to_string(48 + p);
    frame.points.push_back({"60", 1, 300, false});  // inner lips do not count
    numbered.push_back(std::move(frame));
  }
  const Landmarks a = find_rest(named), b = find_rest(numbered);
  for (std::size_t p = 0; p < 12; ++p) EXPECT_EQ(a.points[p].y_px, b.points[p].y_px);
}

TEST(FindRest, TakesFramesThatLostTheChinAndItsPlaceFromOthers) {
  std::vector<Landmarks> frames;
  for (int i = 0; i < 10; ++i) {
    frames.push_back(mouth(8));
    frames.back().points.push_back({"chin", 6, i == 3 ? 40.0 : 90.0, i == 3});
  }
  FindRestOptions all;
  all.still_share = all.to_share = 1;
  all.from_share = 0;
  EXPECT_NEAR(find_rest(frames, all).points[12].y_px, 40, 1e-9);
}

TEST(FindRest, IsShutThoughTheMouthRestsALittleOpen) {
  std::vector<Landmarks> frames;
  for (int i = 0; i < 100; ++i) {
    // At rest from the 40th frame on, ajar by 3 px; every fifth frame before is a bilabial.
    const double gap = i >= 40 ? 3 : i % 5 == 0 ? 1 : 9;
    frames.push_back(mouth(i >= 40 ? 8 : i % 5 == 0 ? 7 : 16));
    frames.back().points.push_back({"inner_lip_2", 5, 10 - gap / 2, true});
    frames.back().points.push_back({"inner_lip_6", 5, 10 + gap / 2, true});
  }
  for (int i = 0; i < 4; ++i) frames[static_cast<std::size_t>(5 * i + 1)] = frames[0];
  const Landmarks rest = find_rest(frames);
  EXPECT_NEAR(rest.points[3].y_px, -4, 1e-9);
  EXPECT_NEAR(rest.points[12].y_px, 9.5, 1e-9);
  EXPECT_NEAR(rest.points[13].y_px, 10.5, 1e-9);
}

TEST(FindRest, LeavesFramesWithALostLipOut) {
  Landmarks lost = mouth(2);
  lost.points[0].valid = false;
  EXPECT_NEAR(find_rest({{lost, mouth(9), lost, lost}}).points[3].y_px, -4.5, 1e-9);
  EXPECT_EQ(find_rest({{lost}}).points[3].y_px, -1);
}

TEST(FindRest, RejectsNoFramesAndPointsWithoutLips) {
  EXPECT_THROW_TEXT(find_rest(engine::Seq<Landmarks>()), "there are no frames");
  EXPECT_THROW_TEXT(find_rest({{Landmarks{{{"chin", 1, 2, true}}}}}),
                    "there is no point lip_11, expected lip_1 to lip_5 and lip_7 to lip_11");
}
