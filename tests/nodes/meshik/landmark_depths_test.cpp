// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/landmark_depths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::meshik;

// The corners of a mouth, a chin and the tip of a nose, 20 mm in front of them.
Rig small_rig() {
  Rig rig;
  rig.neutral.points_mm.resize(68, {0, 0, 0});
  for (std::uint32_t i = 0; i < 68; ++i) rig.landmarks68.push_back(i);
  rig.neutral.points_mm[48] = {-25, 0, 0};
  rig.neutral.points_mm[54] = {25, 0, 0};
  rig.neutral.points_mm[8] = {0, -40, -5};
  rig.neutral.points_mm[30] = {0, 30, 20};
  return rig;
}

// Seen at 0.5 mm a pixel.
Landmarks small_face() {
  return {{{"lip_0", 50, 100}, {"lip_6", 150, 100}, {"chin", 100, 180}, {"nose_tip", 100, 40}}};
}

TEST(LandmarkDepths, AreTheRigsInPixels) {
  const Matrix depths = landmark_depths(small_rig(), small_face());
  ASSERT_EQ(depths.rows, 4u);
  ASSERT_EQ(depths.columns, 1u);
  EXPECT_NEAR(depths.at(0, 0), 0, 1e-9);
  EXPECT_NEAR(depths.at(2, 0), -10, 1e-9);
  EXPECT_NEAR(depths.at(3, 0), 40, 1e-9);
}

TEST(LandmarkDepths, DoNotChangeWithTheRigsUnits) {
  Rig rig = small_rig();
  for (Vec3f& point : rig.neutral.points_mm)
    for (float& x : point) x *= 1000;
  EXPECT_NEAR(landmark_depths(rig, small_face()).at(3, 0), 40, 1e-4);
}

TEST(LandmarkDepths, KnowThePointsByTheirNumbersToo) {
  Landmarks face = small_face();
  const char* names[] = {"48", "54", "08", "30"};
  for (std::size_t i = 0; i < 4; ++i) face.points[i].name = names[i];
  EXPECT_EQ(landmark_depths(small_rig(), face).values, landmark_depths(small_rig(), small_face()).values);
  // No such number: a point of another name.
  face.points.push_back({"68", 80, 80});
  EXPECT_NEAR(landmark_depths(small_rig(), face).at(4, 0), 7.5, 1e-9);
}

TEST(LandmarkDepths, OfAnUnknownPointIsTheMean) {
  Landmarks face = small_face();
  face.points.push_back({"mole", 80, 80});
  EXPECT_NEAR(landmark_depths(small_rig(), face).at(4, 0), 7.5, 1e-9);
}

// Depths of a head that is seen from the front, on one that is turned, moved the mouth over the face when it turned
// back.
TEST(LandmarkDepths, OfAHeadThatIsTurnedAreTurnedToo) {
  Rig rig = small_rig();
  rig.neutral.points_mm[39] = {-15, 45, 0};
  rig.neutral.points_mm[42] = {15, 45, 0};
  const double turn = 0.3;
  const auto turned = [&](const char* name, std::size_t index) {
    const Vec3f& at = rig.neutral.points_mm[index];
    return Landmark{name, 100 + 2 * (std::cos(turn) * at[0] + std::sin(turn) * at[2]), 100 - 2.0 * at[1]};
  };
  const Landmarks face{{turned("lip_0", 48), turned("lip_6", 54), turned("chin", 8), turned("nose_tip", 30),
                        turned("eye_inner_r", 39), turned("eye_inner_l", 42)}};
  const Matrix depths = landmark_depths(rig, face);
  const auto true_depth_px = [&](std::size_t index) {
    const Vec3f& at = rig.neutral.points_mm[index];
    return 2 * (std::cos(turn) * at[2] - std::sin(turn) * at[0]);
  };
  // A corner of the mouth would be off by 15 px.
  EXPECT_NEAR(depths.at(0, 0) - depths.at(1, 0), true_depth_px(48) - true_depth_px(54), 5);
  EXPECT_NEAR(depths.at(4, 0) - depths.at(5, 0), true_depth_px(39) - true_depth_px(42), 3);
}

TEST(LandmarkDepths, RejectAFaceUpsideDown) {
  Landmarks face = small_face();
  for (Landmark& point : face.points) point.x_px *= -1, point.y_px *= -1;
  EXPECT_THROW_TEXT(landmark_depths(small_rig(), face),
                    "the neutral landmarks do not lie as those of an upright face do");
}

}  // namespace
