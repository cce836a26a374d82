// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/mouth.h"

#include <gtest/gtest.h>

#include "nodes/base/pose.h"
#include "tests/nodes/trajectory/simple_mouth.h"
#include "tests/support/expect_throw_text.h"

namespace face {
namespace {

std::vector<float> at(std::string_view name, float weight) {
  std::vector<float> weights(arkit_count, 0.0f);
  weights[arkit_index(name)] = weight;
  return weights;
}

TEST(Mouth, TheNeutralIsClosed) {
  const Rig rig = test::simple_mouth();
  EXPECT_EQ(lip_gap_mm(rig, rig.neutral.points_mm), 0);
}

TEST(Mouth, TheGapIsHowFarTheLipsPart) {
  const Rig rig = test::simple_mouth();
  std::vector<Vec3f> posed = rig.neutral.points_mm;
  posed[0][1] += 3;  // one of three pairs
  const LipGap gap = lip_gap(rig, posed);
  EXPECT_NEAR(gap.mean_mm, 1, 1e-6);
  EXPECT_NEAR(gap.min_mm, 0, 1e-6);
  EXPECT_NEAR(gap.max_mm, 3, 1e-6);
}

TEST(Mouth, TheRowsGiveTheGapOfAnyPose) {
  const Rig rig = test::simple_mouth();
  std::vector<float> weights = at("jawOpen", 0.4f);
  weights[arkit_index("mouthClose")] = 0.3f;
  weights[arkit_index("mouthFunnel")] = 0.2f;
  const LipGap gap = lip_gap(rig, pose_points(rig, {weights}));
  double mean = 0;
  for (const std::vector<double>& row : lip_gap_rows(rig))
    for (std::size_t s = 0; s < arkit_count; ++s) mean += row[s] * weights[s] / 3;
  EXPECT_NEAR(gap.mean_mm, mean, 1e-4);  // positions are floats
}

TEST(Mouth, LipsThatRunIntoEachOtherHaveANegativeGap) {
  const Rig rig = test::simple_mouth();
  EXPECT_LT(lip_gap_mm(rig, pose_points(rig, {at("mouthClose", 0.1f)})), -3);
}

TEST(Mouth, TheLowerLipIsMeasuredToTheSurfaceOfTheTeeth) {
  // Straight behind the lip, 5 mm away, is the front of the plate, whose corners are further.
  const LipTeeth teeth(test::simple_mouth());
  const LipTeethContact contact = teeth.nearest({});
  EXPECT_NEAR(contact.distance_mm, 5, 1e-4);
  EXPECT_NEAR(contact.normal[2], 1, 1e-4);
}

TEST(Mouth, ALipInsideTheTeethHasANegativeDistance) {
  const LipTeeth teeth(test::simple_mouth());
  // Rolled in by 5.5 mm and up by 1.25 mm: half a millimetre behind the front, and more below any other side.
  EXPECT_NEAR(teeth.nearest(at("mouthRollLower", 0.5f)).distance_mm, -0.5, 1e-4);
  EXPECT_NEAR(teeth.depth_mm(at("mouthRollLower", 0.5f)), 0.5, 1e-4);
  EXPECT_EQ(teeth.depth_mm(at("mouthRollLower", 0.4f)), 0);
}

TEST(Mouth, TheRowIsTheChangeOfTheDistance) {
  const LipTeeth teeth(test::simple_mouth());
  const LipTeethContact contact = teeth.nearest({});
  EXPECT_NEAR(teeth.row(contact)[arkit_index("mouthRollLower")], -11, 1e-4);
  EXPECT_NEAR(teeth.nearest(at("mouthRollLower", 0.1f)).distance_mm, 5 - 1.1, 1e-4);
}

TEST(Mouth, RejectsARigWithoutPairs) {
  Rig rig = test::simple_mouth();
  rig.inner_lips.clear();
  EXPECT_THROW_TEXT(lip_gap_mm(rig, rig.neutral.points_mm),
                    "the rig names no inner lip pairs, so its lip gap cannot be measured");
}

TEST(Mouth, RejectsAPoseOfAnotherMesh) {
  EXPECT_THROW_TEXT(lip_gap_mm(test::simple_mouth(), {}), "the pose has 0 vertices, the rig has 14");
}

TEST(Mouth, RejectsAVertexThatIsNotThere) {
  Rig rig = test::simple_mouth();
  rig.upper_teeth.push_back(99);
  EXPECT_THROW_TEXT(LipTeeth{rig}, "vertex 99 of the rig's upper teeth is outside its 14 vertices");
}

TEST(Mouth, WithoutTeethThereIsNothingToMeasure) {
  Rig rig = test::simple_mouth();
  rig.upper_teeth.clear();
  EXPECT_FALSE(LipTeeth(rig).usable());
  EXPECT_THROW_TEXT(LipTeeth(rig).nearest({}),
                    "the rig names no lower lip or no upper teeth, so their distance cannot be measured");
}

}  // namespace
}  // namespace face
