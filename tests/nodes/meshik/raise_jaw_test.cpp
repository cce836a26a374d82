// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/raise_jaw.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/types/arkit.h"
#include "tests/nodes/meshik/landmark_rig.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::meshik;

// Its jaw takes the lower lip along; mouthClose brings the lips together again.
Rig speaking_rig() {
  Rig rig = test::landmark_rig();
  rig.shapes.resize(arkit_count);
  for (std::size_t s = 0; s < arkit_count; ++s) rig.shapes[s].name = arkit_names[s];
  const auto move = [&](const char* name, std::vector<std::uint32_t> vertices, std::vector<float> up_mm) {
    Shape& shape = rig.shapes[arkit_index(name)];
    for (const float up : up_mm) shape.offsets_mm.push_back({0, up, 0});
    shape.vertices = std::move(vertices);
  };
  move("jawOpen", {7, 8, 9, 55, 56, 57, 58, 59, 66}, {-20, -20, -20, -16, -16, -16, -16, -16, -16});
  move("mouthClose", {49, 50, 51, 52, 53, 55, 56, 57, 58, 59, 62, 66},
       {-4, -4, -4, -4, -4, 12, 12, 12, 12, 12, -4, 12});
  move("mouthLowerDownLeft", {55, 56, 57, 58, 59, 66}, {-9, -8, -9, -8, -9, -8});
  return rig;
}

// The rig's landmarks at these weights, seen by a camera of 0.5 mm per pixel.
Landmarks seen(const Rig& rig, float jaw, float close, float down) {
  std::vector<Vec3f> points = rig.neutral.points_mm;
  const auto add = [&](const char* name, float weight) {
    const Shape& shape = rig.shapes[arkit_index(name)];
    for (std::size_t i = 0; i < shape.vertices.size(); ++i)
      points[shape.vertices[i]][1] += weight * shape.offsets_mm[i][1];
  };
  add("jawOpen", jaw);
  add("mouthClose", close);
  add("mouthLowerDownLeft", down);
  Landmarks landmarks;
  const auto mark = [&](const std::string& name, std::size_t i) {
    landmarks.points.push_back({name, 180 + double{points[i][0]} / 0.5, 200 - double{points[i][1]} / 0.5, true});
  };
  mark("eye_inner_r", 39);
  mark("eye_inner_l", 42);
  mark("nose_tip", 30);
  for (std::size_t i = 0; i < 12; ++i) mark("lip_" + std::to_string(i), 48 + i);
  mark("jaw_r", 7);
  mark("chin", 8);
  mark("jaw_l", 9);
  return landmarks;
}

// Speech without a pause: vowels, P with shut lips over a hanging jaw, S with the jaw up and the lips apart.
std::vector<Landmarks> speech(const Rig& rig) {
  std::vector<Landmarks> frames;
  for (int i = 0; i < 5; ++i) {
    for (const float jaw : {0.3f, 0.5f, 0.3f}) frames.push_back(seen(rig, jaw, 0, 0.1f));
    for (int k = 0; k < 3; ++k) frames.push_back(seen(rig, 0.1f, 0.1f, 0));
    for (int k = 0; k < 3; ++k) frames.push_back(seen(rig, 0, 0, 0.6f));
  }
  return frames;
}

double farthest_px(const Landmarks& a, const Landmarks& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    most = std::max(most, std::hypot(a.points[i].x_px - b.points[i].x_px, a.points[i].y_px - b.points[i].y_px));
  return most;
}

TEST(RaiseJaw, FindsTheRestOfSomebodyWhoNeverRests) {
  const Rig rig = speaking_rig();
  const Landmarks shut = seen(rig, 0.1f, 0.1f, 0), truth = seen(rig, 0, 0, 0);
  EXPECT_GT(farthest_px(shut, truth), 3.9);
  EXPECT_LT(farthest_px(raise_jaw(rig, engine::Seq<Landmarks>(speech(rig)), shut, nullptr), truth),
            0.8);  // weights are pulled to 0
}

TEST(RaiseJaw, BelievesAMouthThatRestsLongerThanAnyClosure) {
  const Rig rig = speaking_rig();
  const Landmarks rest = seen(rig, 0.1f, 0.1f, 0);
  std::vector<Landmarks> frames = speech(rig);
  frames.insert(frames.end(), 9, rest);  // the last 3 frames of speech are others
  EXPECT_GT(farthest_px(raise_jaw(rig, engine::Seq<Landmarks>(frames), rest, nullptr), rest), 1);
  frames.insert(frames.end(), 3, rest);
  EXPECT_EQ(farthest_px(raise_jaw(rig, engine::Seq<Landmarks>(frames), rest, nullptr), rest), 0);
}

TEST(RaiseJaw, TakesAFewClosuresThatFollowEachOtherInALongClipForNoRest) {
  const Rig rig = speaking_rig();
  const Landmarks shut = seen(rig, 0.1f, 0.1f, 0), truth = seen(rig, 0, 0, 0);
  std::vector<Landmarks> frames(14, shut);
  for (int i = 0; i < 31; ++i)
    for (const Landmarks& frame : speech(rig)) frames.push_back(frame);
  EXPECT_LT(farthest_px(raise_jaw(rig, engine::Seq<Landmarks>(frames), shut, nullptr), truth), 0.8);
  frames.resize(500);
  EXPECT_EQ(farthest_px(raise_jaw(rig, engine::Seq<Landmarks>(frames), shut, nullptr), shut), 0);
}

TEST(RaiseJaw, LeavesARestThatIsOne) {
  const Rig rig = speaking_rig();
  const Landmarks rest = seen(rig, 0, 0, 0);
  EXPECT_LT(farthest_px(raise_jaw(rig, engine::Seq<Landmarks>(speech(rig)), rest, nullptr), rest), 0.1);
}

TEST(RaiseJaw, IsNotLedAstrayByAFrameOrTwoNorByLostPoints) {
  const Rig rig = speaking_rig();
  const Landmarks rest = seen(rig, 0, 0, 0);
  std::vector<Landmarks> frames = speech(rig);
  frames[8] = frames[20] = seen(rig, -0.4f, 0, 0);
  for (Landmarks& frame : frames) frame.points[16] = {"chin", 180, 250, false};
  EXPECT_LT(farthest_px(raise_jaw(rig, engine::Seq<Landmarks>(frames), rest, nullptr), rest), 0.1);
}

TEST(RaiseJaw, RaisesByNoMoreThanMost) {
  const Rig rig = speaking_rig();
  const Landmarks shut = seen(rig, 0.5f, 0.5f, 0);
  const Landmarks raised = raise_jaw(rig, engine::Seq<Landmarks>(speech(rig)), shut, nullptr);
  EXPECT_NEAR(shut.points[16].y_px - raised.points[16].y_px, 0.15 * 20 / 0.5, 0.6);  // the scale is of the wrong rest
}

TEST(RaiseJaw, LeavesTheRestWhereTheRigCannotShutItsMouthOrNoFrameIsSeen) {
  Rig rig = speaking_rig();
  const Landmarks shut = seen(rig, 0.1f, 0.1f, 0);
  EXPECT_EQ(farthest_px(raise_jaw(rig, engine::Seq<Landmarks>(), shut, nullptr), shut), 0);
  const std::vector<Landmarks> frames = speech(rig);
  rig.shapes[arkit_index("mouthClose")] = {"mouthClose", {}, {}};
  EXPECT_EQ(farthest_px(raise_jaw(rig, engine::Seq<Landmarks>(frames), shut, nullptr), shut), 0);
}

TEST(RaiseJaw, RejectsFramesOfOtherLandmarks) {
  const Rig rig = speaking_rig();
  const Landmarks rest = seen(rig, 0, 0, 0);
  Landmarks fewer = rest;
  fewer.points.pop_back();
  EXPECT_THROW_TEXT(raise_jaw(rig, engine::Seq<Landmarks>(std::vector<Landmarks>{rest, fewer}), rest, nullptr),
                    "frame 1 has 17 landmarks, expected 18 as rest");
}

}  // namespace
