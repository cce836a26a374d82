// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/scale_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/mmm/example_meshes.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

// 68 vertices: point i of the 68 is vertex i, at 2 mm per pixel across and 3 mm down about pixel (100, 100).
Landmarks points() {
  Landmarks made;
  for (int i = 0; i < 68; ++i) {
    double x = 40 * std::cos(0.7 * i), y = 40 * std::sin(0.7 * i);
    if (i >= 48) x /= 4, y = y / 8 + 20;
    made.points.push_back({(i < 10 ? "0" : "") + std::to_string(i), 100 + x, 100 + y, true});
  }
  return made;
}
Rig rig() {
  Rig made;
  for (const Landmark& p : points().points) {
    made.landmarks68.push_back(static_cast<std::uint32_t>(made.neutral.points_mm.size()));
    made.neutral.points_mm.push_back(
        {static_cast<float>(2 * (p.x_px - 100)), static_cast<float>(-3 * (p.y_px - 100)), 7});
  }
  made.shapes = {{"jawOpen", {3}, {{0, -9, 0}}}, {"mouthLeft", {}, {}}};
  return made;
}

TEST(ScaleMotion, OfTheReferenceAsksForTheMeshAtRest) {
  const VertexTargets targets = scale_motion(rig(), points(), points(), nullptr);
  ASSERT_EQ(targets.targets.size(), 68u);
  for (const VertexTarget& t : targets.targets) {
    EXPECT_NEAR(t.x_mm, static_cast<double>(rig().neutral.points_mm[t.vertex][0]), 1e-5);
    EXPECT_NEAR(t.y_mm, static_cast<double>(rig().neutral.points_mm[t.vertex][1]), 1e-5);
    EXPECT_FALSE(t.has_z);
  }
}

TEST(ScaleMotion, ScalesAcrossAndDownByTheBoxesOfThePart) {
  Landmarks moved = points();
  moved.points[57].x_px += 2, moved.points[57].y_px += 4;
  const VertexTargets targets = scale_motion(rig(), points(), moved, nullptr);
  EXPECT_NEAR(targets.targets[57].x_mm - static_cast<double>(rig().neutral.points_mm[57][0]), 4, 1e-4);
  EXPECT_NEAR(targets.targets[57].y_mm - static_cast<double>(rig().neutral.points_mm[57][1]), -12, 1e-4);
}

TEST(ScaleMotion, GivesTheMouthItsOwnScale) {
  Rig wide = rig();
  for (std::size_t i = 48; i < 68; ++i) wide.neutral.points_mm[i][0] *= 2;
  Landmarks moved = points();
  moved.points[57].x_px += 1, moved.points[5].x_px += 1;
  const VertexTargets targets = scale_motion(wide, points(), moved, nullptr);
  EXPECT_NEAR(targets.targets[57].x_mm - static_cast<double>(wide.neutral.points_mm[57][0]), 4, 1e-4);
  EXPECT_NEAR(targets.targets[5].x_mm - static_cast<double>(wide.neutral.points_mm[5][0]), 2, 1e-4);
}

TEST(ScaleMotion, TakesTheHeadsMotionOut) {
  Landmarks moved = points();
  for (Landmark& p : moved.points) {
    const double x = p.x_px, y = p.y_px;
    p.x_px = 1.05 * x - 0.08 * y + 12, p.y_px = 0.08 * x + 1.05 * y - 7;
  }
  const VertexTargets held = scale_motion(rig(), points(), moved, nullptr),
                      rest = scale_motion(rig(), points(), points(), nullptr);
  for (std::size_t i = 0; i < 68; ++i) EXPECT_NEAR(held.targets[i].x_mm, rest.targets[i].x_mm, 1e-6);
  EXPECT_GT(std::abs(scale_motion(rig(), points(), moved, nullptr, {false}).targets[0].x_mm - rest.targets[0].x_mm), 1);
}

TEST(ScaleMotion, InnerLipsOfAClipAreScaledAsTheOuterOnes) {
  Rig wide = rig();
  for (std::size_t i = 48; i < 68; ++i) wide.neutral.points_mm[i][0] *= 2;
  Landmarks clip = points();
  for (const auto& [from, name] : {std::pair{54, "lip_6"}, {57, "lip_9"}, {60, "inner_lip_0"}, {64, "inner_lip_4"}})
    clip.points[static_cast<std::size_t>(from)].name = name;
  Landmarks moved = clip;
  moved.points[60].x_px += 1;
  const VertexTargets targets = scale_motion(wide, clip, moved, nullptr);
  EXPECT_NEAR(targets.targets[60].x_mm - static_cast<double>(wide.neutral.points_mm[60][0]), 4, 1e-4);
}

TEST(ScaleMotion, ABoxOfTooFewPointsUsesTheWholeFaces) {
  Landmarks few = points();
  few.points.erase(few.points.begin() + 50, few.points.end());
  Landmarks moved = few;
  moved.points[49].x_px += 3;
  const VertexTargets targets = scale_motion(rig(), few, moved, nullptr);
  EXPECT_NEAR(targets.targets[49].x_mm - static_cast<double>(rig().neutral.points_mm[49][0]), 6, 1e-4);
}

TEST(ScaleMotion, LostPointsAskForNothing) {
  Landmarks moved = points();
  moved.points[60].valid = false;
  EXPECT_EQ(scale_motion(rig(), points(), moved, nullptr).targets.size(), 67u);
  EXPECT_TRUE(scale_motion(rig(), points(), Landmarks{}, nullptr).targets.empty());
}

TEST(ScaleMotion, HoldsStillVerticesBesideThePoints) {
  Landmarks moved = points();
  moved.points[57].x_px += 2;
  // The rig has a vertex more than points.
  Rig more = rig();
  more.neutral.points_mm.push_back({1, 2, 3});
  const VertexTargets still{{{57, 0, 0, 0, true}, {68, 1, 2, 3, true}}};
  const VertexTargets without = scale_motion(more, points(), moved, nullptr);
  const VertexTargets held = scale_motion(more, points(), moved, &still);
  ASSERT_EQ(held.targets.size(), 69u);
  EXPECT_EQ(held.targets[57].x_mm, without.targets[57].x_mm);
  EXPECT_FALSE(held.targets[57].has_z);
  EXPECT_EQ(held.targets[68].vertex, 68u);
  EXPECT_EQ(held.targets[68].z_mm, 3);
  EXPECT_TRUE(held.targets[68].has_z);
  EXPECT_THROW_TEXT(scale_motion(rig(), points(), moved, &still), "a still vertex is 68, the rig has 68");
}

TEST(ScaleMotion, RejectsARigWithoutLandmarks) {
  EXPECT_THROW_TEXT(scale_motion(Rig{}, points(), points(), nullptr),
                    "the rig has 0 landmarks, expected 68, as the embedded head, ICT-FaceKit folders and GLB files "
                    "that were made of these have; transfer.mark_landmarks finds those of another head");
}

TEST(ExampleMeshes, ArePosesOfTheRig) {
  std::vector<Mesh> examples;
  engine::SeqWriter<Mesh> writer([&](std::string, Mesh mesh) { examples.push_back(std::move(mesh)); });
  const Mesh reference = example_meshes(rig(), writer, {{"jawOpen"}});
  ASSERT_EQ(examples.size(), 1u);
  EXPECT_FLOAT_EQ(examples[0].points_mm[3][1], reference.points_mm[3][1] - 9);
  EXPECT_EQ(examples[0].points_mm[4], reference.points_mm[4]);
}

TEST(ExampleMeshes, LeaveOutWhatTheRigCannotDo) {
  std::vector<std::string> ids;
  engine::SeqWriter<Mesh> writer([&](std::string id, Mesh) { ids.push_back(id); });
  example_meshes(rig(), writer, {{"mouthLeft", "mouthClose", "jawOpen"}});
  EXPECT_EQ(ids, std::vector<std::string>{"jawOpen"});
  EXPECT_THROW_TEXT(example_meshes(rig(), writer, {{"mouthLeft"}}),
                    "no shape of the 1 that are asked for moves a vertex of the rig");
  EXPECT_THROW_TEXT(example_meshes(rig(), writer, {{"jawopen"}}), "the rig has no shape \"jawopen\"");
}

}  // namespace
}  // namespace face::mmm
