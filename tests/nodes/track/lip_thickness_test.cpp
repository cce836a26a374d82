// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/lip_thickness.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "nodes/base/find_landmark.h"

namespace {

using namespace face;
using namespace face::track;

// Three lines across a mouth whose lips are so thick.
Landmarks mouth(double upper_px, double gap_px, double lower_px) {
  Landmarks points;
  const auto add = [&](const char* kind, int number, double y_px) {
    points.points.push_back({kind + std::to_string(number), 10.0, y_px, true});
  };
  for (int line = 1; line <= 3; ++line) {
    add("lip_", line + 1, 100);
    add("inner_lip_", line, 100 + upper_px);
    add("inner_lip_", 8 - line, 100 + upper_px + gap_px);
    add("lip_", 11 - line, 100 + upper_px + gap_px + lower_px);
  }
  return points;
}

double y_of(const Landmarks& points, const char* name) { return find_landmark(points, name)->y_px; }

std::vector<Landmarks> frames(int open, const Landmarks& mouth_when_open, const Landmarks& rest) {
  std::vector<Landmarks> all(20, rest);
  for (int i = 0; i < open; ++i) all[static_cast<std::size_t>(i)] = mouth_when_open;
  return all;
}

}  // namespace

// What shows between lips that are not quite together was taken for lips, and hid as much of every opening.
TEST(LipThickness, IsThatOfOpenMouthsWhereLipsAreNeverTogether) {
  const Landmarks rest = mouth(8, 0, 12), found = lip_thickness(frames(8, mouth(7, 9, 10.5), rest), rest);
  EXPECT_NEAR(y_of(found, "inner_lip_2") - y_of(found, "lip_3"), 7, 1e-9);
  EXPECT_NEAR(y_of(found, "lip_9") - y_of(found, "inner_lip_6"), 10.5, 1e-9);
  EXPECT_EQ(y_of(found, "lip_3"), y_of(rest, "lip_3"));
}

// In blurred and hard pictures half of every lip was taken for the mouth's hollow, and the mouth gaped.
TEST(LipThickness, IsHardlyThinnerThanAtRestWhateverOpenMouthsShow) {
  const Landmarks rest = mouth(8, 0, 12), found = lip_thickness(frames(8, mouth(4, 14, 6), rest), rest);
  EXPECT_NEAR(y_of(found, "inner_lip_2") - y_of(found, "lip_3"), 0.8 * 8, 1e-9);
  EXPECT_NEAR(y_of(found, "lip_9") - y_of(found, "inner_lip_6"), 0.8 * 12, 1e-9);
}

TEST(LipThickness, IsThatOfRestWhereATongueLooksLikeALip) {
  const Landmarks rest = mouth(8, 0.5, 12), found = lip_thickness(frames(8, mouth(8, 9, 18), rest), rest);
  for (const char* name : {"inner_lip_1", "inner_lip_6"}) EXPECT_NEAR(y_of(found, name), y_of(rest, name), 1e-9);
}

TEST(LipThickness, IsThatOfRestWhereNoMouthIsOpen) {
  const Landmarks rest = mouth(8, 0.5, 12), found = lip_thickness(frames(8, mouth(6, 1, 10), rest), rest);
  EXPECT_EQ(y_of(found, "inner_lip_2"), y_of(rest, "inner_lip_2"));
}

TEST(LipThickness, MindsNeitherASingleFrameNorALostPoint) {
  const Landmarks rest = mouth(8, 0.5, 12);
  std::vector<Landmarks> all = frames(10, mouth(8, 9, 12), rest);
  all[0] = mouth(2, 15, 5);
  for (std::size_t i = 1; i < 5; ++i) {
    all[i] = mouth(2, 15, 5);
    for (Landmark& point : all[i].points) point.valid = false;
  }
  EXPECT_NEAR(y_of(lip_thickness(all, rest), "inner_lip_2"), y_of(rest, "inner_lip_2"), 1e-9);
}

TEST(LipThickness, OfARestWithoutInnerPointsIsRest) {
  const Landmarks rest{{{"lip_3", 1, 2}}};
  EXPECT_EQ(lip_thickness(frames(8, mouth(6, 9, 10), rest), rest).points.size(), 1u);
}
