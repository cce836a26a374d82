// SPDX-License-Identifier: Apache-2.0
// What the 52 shapes of the embedded head must do, and must not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "nodes/types/arkit.h"
#include "tests/nodes/phantom/head_probe.h"

namespace {

using face::Shape;
using face::Vec3f;
using namespace probe;

TEST(HeadShapes, AreTheFiftyTwoOfArkitInOrderAndNoneIsEmpty) {
  ASSERT_EQ(head().shapes.size(), face::arkit_count);
  EXPECT_TRUE(head().missing.empty());
  for (std::size_t s = 0; s < face::arkit_count; ++s) {
    const Shape& shape = head().shapes[s];
    EXPECT_EQ(shape.name, face::arkit_names[s]);
    EXPECT_GT(shape.vertices.size(), 20u) << shape.name;
    ASSERT_EQ(shape.vertices.size(), shape.offsets_mm.size());
    EXPECT_TRUE(std::is_sorted(shape.vertices.begin(), shape.vertices.end())) << shape.name;
    EXPECT_LT(shape.vertices.back(), head().neutral.points_mm.size());
    double largest = 0;
    for (const Vec3f& offset : shape.offsets_mm) {
      for (const float x : offset) ASSERT_TRUE(std::isfinite(x));
      largest = std::max(largest, distance(offset, {0, 0, 0}));
    }
    EXPECT_GT(largest, 1.0) << shape.name << " can be seen";
    EXPECT_LT(largest, 60.0) << shape.name;
  }
}

// The offset of the vertex at the mirrored place.
std::map<Vec3f, Vec3f> by_place(const Shape& shape, bool mirrored) {
  std::map<Vec3f, Vec3f> offsets;
  for (std::size_t k = 0; k < shape.vertices.size(); ++k) {
    Vec3f place = head().neutral.points_mm[shape.vertices[k]], offset = shape.offsets_mm[k];
    if (mirrored) place[0] = -place[0], offset[0] = -offset[0];
    offsets[{place[0] + 0.0f, place[1], place[2]}] = {offset[0] + 0.0f, offset[1], offset[2]};
  }
  return offsets;
}

TEST(HeadShapes, OfTheLeftMirrorThoseOfTheRightExactly) {
  std::size_t pairs = 0, middle = 0;
  for (const Shape& shape : head().shapes) {
    std::string other = shape.name;
    const std::size_t left = other.find("Left"), right = other.find("Right");
    if (right != std::string::npos) continue;
    if (left != std::string::npos) other.replace(left, 4, "Right");
    const Shape& partner = head().shapes[face::arkit_index(other)];
    EXPECT_EQ(by_place(shape, false), by_place(partner, true)) << shape.name << " and " << other;
    ++(left != std::string::npos ? pairs : middle);
  }
  EXPECT_EQ(pairs, 20u);
  EXPECT_EQ(middle, 12u);
}

// Where a shape may act, on the neutral head, and which parts it may move. Boxes are for the left side; mm.
struct Region {
  double low_x, high_x, low_y, high_y;
  std::set<std::string> parts;
};
Region region_of(const std::string& name) {
  const std::set<std::string> eye = {"face", "sclera_left", "iris_left", "lashes", "brows"};
  const std::set<std::string> skin = {"face", "brows", "lashes"};
  const std::set<std::string> lips = {"face", "mouth_socket"};
  const std::set<std::string> jaw = {"face", "mouth_socket", "teeth", "gums", "tongue"};
  const bool left = name.find("Left") != std::string::npos && name != "mouthLeft" && name != "jawLeft";
  if (name == "tongueOut") return {-30, 30, -70, -20, {"tongue"}};
  if (name.starts_with("eye")) return {4, 75, 0, 75, eye};
  if (name == "browInnerUp") return {-45, 45, 22, 100, skin};
  if (name.starts_with("brow")) return {-3, 70, 22, 100, skin};
  if (name.starts_with("jaw")) return {-90, 90, -150, 25, jaw};
  if (name == "cheekPuff") return {-80, 80, -80, 30, lips};
  if (name == "cheekSquintLeft") return {3, 80, -40, 35, {"face"}};
  if (name == "noseSneerLeft") return {-8, 50, -30, 70, {"face", "brows"}};
  return {left ? -14.0 : -80.0, 80, -100, 25, lips};
}

TEST(HeadShapes, MoveTheirOwnRegionOnly) {
  for (const Shape& shape : head().shapes) {
    if (shape.name.find("Right") != std::string::npos) continue;  // mirror images, see above
    const Region region = region_of(shape.name);
    std::set<std::uint32_t> allowed;
    for (const std::string& part : region.parts)
      for (const std::uint32_t v : part_vertices(part)) allowed.insert(v);
    for (std::size_t k = 0; k < shape.vertices.size(); ++k) {
      const std::uint32_t v = shape.vertices[k];
      const Vec3f p = head().neutral.points_mm[v];
      ASSERT_TRUE(allowed.count(v)) << shape.name << " moves vertex " << v << " of another part";
      const bool inside =
          p[0] >= region.low_x && p[0] <= region.high_x && p[1] >= region.low_y && p[1] <= region.high_y;
      ASSERT_TRUE(inside || distance(shape.offsets_mm[k], {0, 0, 0}) < 0.25)
          << shape.name << " moves (" << p[0] << ", " << p[1] << ", " << p[2] << ") by "
          << distance(shape.offsets_mm[k], {0, 0, 0}) << " mm";
    }
  }
}

TEST(HeadShapes, LeaveTheUpperTeethWhereTheyAre) {
  const std::set<std::uint32_t> teeth(head().upper_teeth.begin(), head().upper_teeth.end());
  for (const Shape& shape : head().shapes)
    for (const std::uint32_t v : shape.vertices) ASSERT_FALSE(teeth.count(v)) << shape.name;
}

double lid_gap(const std::vector<Vec3f>& points, bool left) {
  const std::vector<std::uint32_t>& marks = head().landmarks68;
  const std::size_t first = left ? 42 : 36;
  return std::max(distance(points[marks[first + 1]], points[marks[first + 5]]),
                  distance(points[marks[first + 2]], points[marks[first + 4]]));
}

TEST(HeadShapes, BlinkClosesTheLidsToHalfAMillimetre) {
  EXPECT_GT(lid_gap(head().neutral.points_mm, true), 8);
  EXPECT_LE(lid_gap(posed({{"eyeBlinkLeft", 1.0f}}), true), 0.5);
  EXPECT_LE(lid_gap(posed({{"eyeBlinkRight", 1.0f}}), false), 0.5);
  EXPECT_GT(lid_gap(posed({{"eyeBlinkLeft", 1.0f}}), false), 8) << "the other eye stays open";
  EXPECT_LT(lid_gap(posed({{"eyeSquintLeft", 1.0f}}), true), lid_gap(head().neutral.points_mm, true) - 2);
  EXPECT_GT(lid_gap(posed({{"eyeWideLeft", 1.0f}}), true), lid_gap(head().neutral.points_mm, true) + 1.5);
}

// Mean place of a part.
Vec3f middle(const std::vector<Vec3f>& points, std::string_view part) {
  Vec3f sum = {0, 0, 0};
  const std::vector<std::uint32_t> vertices = part_vertices(part);
  for (const std::uint32_t v : vertices)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += points[v][k] / static_cast<float>(vertices.size());
  return sum;
}

TEST(HeadShapes, LookWhereTheirNamesSay) {
  const Vec3f rest = middle(head().neutral.points_mm, "iris_left");
  EXPECT_GT(middle(posed({{"eyeLookUpLeft", 1.0f}}), "iris_left")[1], rest[1] + 4);
  EXPECT_LT(middle(posed({{"eyeLookDownLeft", 1.0f}}), "iris_left")[1], rest[1] - 4);
  EXPECT_LT(middle(posed({{"eyeLookInLeft", 1.0f}}), "iris_left")[0], rest[0] - 4) << "in is towards the nose";
  EXPECT_GT(middle(posed({{"eyeLookOutLeft", 1.0f}}), "iris_left")[0], rest[0] + 4);
}

TEST(HeadShapes, MoveTheJawToTheHeadsOwnLeft) {
  const std::uint32_t chin = head().landmarks68[8];
  const auto moved = [&](std::string_view name) {
    Vec3f d = posed({{name, 1.0f}})[chin];
    for (std::size_t k = 0; k < 3; ++k) d[k] -= head().neutral.points_mm[chin][k];
    return d;
  };
  EXPECT_GT(moved("jawLeft")[0], 4);
  EXPECT_LT(moved("jawRight")[0], -4);
  EXPECT_GT(moved("jawForward")[2], 4);
  EXPECT_LT(moved("jawOpen")[1], -20);
}

TEST(HeadShapes, OpenTheJawByThirtyMillimetres) {
  EXPECT_GE(narrowest_lip_gap(posed({{"jawOpen", 1.0f}})), 30);
  EXPECT_LE(widest_lip_gap(posed({{"jawOpen", 1.0f}})), 45);
}

TEST(HeadShapes, KeepTheNeutralMouthShut) {
  EXPECT_NEAR(widest_lip_gap(head().neutral.points_mm), 0, 1e-3);
  EXPECT_NEAR(narrowest_lip_gap(head().neutral.points_mm), 0, 1e-3);
}

TEST(HeadShapes, CloseTheMouthAtEveryOpeningOfTheJaw) {
  for (const float w : {0.05f, 0.15f, 0.3f, 0.6f, 1.0f}) {
    const auto points = posed({{"jawOpen", w}, {"mouthClose", w}});
    for (const face::LipPair& pair : head().inner_lips)
      EXPECT_LT(distance(points[pair.upper], points[pair.lower]), 0.02) << "at " << w;
  }
}

TEST(HeadShapes, NarrowTheMouthByAQuarterWhenTheLipsPucker) {
  const std::vector<std::uint32_t>& marks = head().landmarks68;
  const auto width = [&](const std::vector<Vec3f>& p) { return double{p[marks[54]][0]} - p[marks[48]][0]; };
  const double rest = width(head().neutral.points_mm);
  EXPECT_NEAR(rest, 51, 3);
  EXPECT_LE(width(posed({{"mouthPucker", 1.0f}})), 0.75 * rest);
  EXPECT_LT(width(posed({{"mouthFunnel", 1.0f}})), 0.90 * rest);
  EXPECT_GT(width(posed({{"mouthStretchLeft", 1.0f}, {"mouthStretchRight", 1.0f}})), 1.15 * rest);
  EXPECT_GT(width(posed({{"mouthSmileLeft", 1.0f}, {"mouthSmileRight", 1.0f}})), 1.10 * rest);
}

TEST(HeadShapes, RaiseOrLowerTheCornersOfTheMouth) {
  const std::uint32_t corner = head().landmarks68[54];
  const float rest = head().neutral.points_mm[corner][1];
  EXPECT_GT(posed({{"mouthSmileLeft", 1.0f}})[corner][1], rest + 4);
  EXPECT_LT(posed({{"mouthFrownLeft", 1.0f}})[corner][1], rest - 4);
}

// Speech: what the viseme table combines.
TEST(HeadShapes, PressTheLipsTogetherForBilabials) {
  const auto points = posed({{"jawOpen", 0.15f},
                             {"mouthClose", 0.15f},
                             {"mouthRollLower", 0.4f},
                             {"mouthRollUpper", 0.4f},
                             {"mouthPressLeft", 0.3f},
                             {"mouthPressRight", 0.3f}});
  EXPECT_GE(narrowest_lip_gap(points), -0.3);
  EXPECT_LE(widest_lip_gap(points), 0.3);
}

TEST(HeadShapes, BringTheLowerLipToTheUpperTeethForLabiodentals) {
  EXPECT_GT(lip_to_teeth(head().neutral.points_mm), 1.2);
  EXPECT_LE(lip_to_teeth(posed({{"mouthRollLower", 0.9f}, {"mouthUpperUpLeft", 0.4f}, {"mouthUpperUpRight", 0.4f}})),
            1.0);
  EXPECT_LE(lip_to_teeth(
                posed({{"jawOpen", 0.1f}, {"mouthClose", 0.08f}, {"mouthRollLower", 0.9f}, {"mouthShrugUpper", 0.5f}})),
            1.0);
}

TEST(HeadShapes, RoundTheLipsWithAnOpeningForRoundVowels) {
  const auto points = posed({{"mouthFunnel", 0.4f}, {"mouthPucker", 0.6f}, {"jawOpen", 0.08f}});
  EXPECT_GT(narrowest_lip_gap(points), 2);
  const std::uint32_t lip = head().inner_lips[head().inner_lips.size() / 2].upper;
  EXPECT_GT(points[lip][2], head().neutral.points_mm[lip][2] + 5);
}

}  // namespace
