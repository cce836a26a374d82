// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/bake_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::meshik;

constexpr std::size_t vertices = 40;

Rig rig_at_rest() {
  Rig rig;
  for (std::size_t i = 0; i < vertices; ++i)
    rig.neutral.points_mm.push_back({static_cast<float>(i), static_cast<float>(i % 7), 3.0f});
  rig.shapes.push_back({"jawOpen", {1}, {{0, 1, 0}}});
  return rig;
}

MeshPoints frame(const Rig& rig, double t) {
  MeshPoints points{rig.neutral.points_mm};
  for (std::size_t i = 0; i < vertices; ++i) {
    points.points_mm[i][1] -= static_cast<float>(5 * std::sin(t) * static_cast<double>(i) / vertices);
    points.points_mm[i][0] += static_cast<float>(2 * std::cos(2 * t) * std::cos(static_cast<double>(i)));
  }
  return points;
}

struct Baked {
  BakeShapesResult result;
  std::vector<Weights> weights;
  std::vector<std::string> ids;
};

Baked bake(const Rig& rig, const engine::Seq<MeshPoints>& points, const BakeShapesOptions& options = {}) {
  Baked baked;
  engine::SeqWriter<Weights> writer([&](std::string id, Weights value) {
    baked.ids.push_back(std::move(id));
    baked.weights.push_back(std::move(value));
  });
  engine::Progress progress;
  baked.result = bake_shapes(rig, points, writer, options, progress);
  return baked;
}

double worst_mm(const Baked& baked, std::size_t frame, const MeshPoints& wanted) {
  std::vector<Vec3f> posed = baked.result.rig.neutral.points_mm;
  for (std::size_t s = 0; s < baked.result.rig.shapes.size(); ++s) {
    const Shape& shape = baked.result.rig.shapes[s];
    for (std::size_t i = 0; i < shape.vertices.size(); ++i)
      for (std::size_t d = 0; d < 3; ++d)
        posed[shape.vertices[i]][d] += baked.weights[frame].values[s] * shape.offsets_mm[i][d];
  }
  double worst = 0;
  for (std::size_t i = 0; i < posed.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d)
      worst = std::max(worst, static_cast<double>(std::abs(posed[i][d] - wanted.points_mm[i][d])));
  return worst;
}

}  // namespace

TEST(BakeShapes, GivesBackAMotionOfTwoShapes) {
  const Rig rig = rig_at_rest();
  std::vector<MeshPoints> frames;
  std::vector<std::string> ids;
  for (int i = 0; i < 25; ++i) {
    frames.push_back(frame(rig, 0.3 * i));
    ids.push_back("f" + std::to_string(10 + i));
  }
  const Baked baked = bake(rig, {frames, ids}, {.tolerance_mm = 1e-3});
  EXPECT_EQ(baked.result.rig.shapes.size(), 2u);
  EXPECT_EQ(baked.result.rig.shapes[0].name, "motion_0");
  EXPECT_EQ(baked.ids, ids);
  float largest = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_LT(worst_mm(baked, i, frames[i]), 1e-3) << i;
    largest = std::max(largest, std::abs(baked.weights[i].values[1]));
  }
  EXPECT_FLOAT_EQ(largest, 1);
  EXPECT_LT(baked.result.largest_mm, 1e-3);
}

TEST(BakeShapes, SaysWhatFewerShapesLeave) {
  const Rig rig = rig_at_rest();
  std::vector<MeshPoints> frames;
  for (int i = 0; i < 25; ++i) frames.push_back(frame(rig, 0.3 * i));
  const Baked baked = bake(rig, {frames}, {.max_shapes = 1});
  EXPECT_EQ(baked.result.rig.shapes.size(), 1u);
  EXPECT_GT(baked.result.largest_mm, 0.5);
  EXPECT_GT(baked.result.rms_mm, 0.1);
}

TEST(BakeShapes, HoldsAFrameWithoutVertices) {
  const Rig rig = rig_at_rest();
  const Baked baked = bake(rig, {{frame(rig, 1), MeshPoints{}, frame(rig, 2)}});
  EXPECT_EQ(baked.weights[1].values, baked.weights[0].values);
}

// A clip of one frame, or whose face is never found, ended with "the rig has no shapes".
TEST(BakeShapes, GivesAStillHeadOneShapeThatMovesNothing) {
  const Rig rig = rig_at_rest();
  const Baked baked = bake(rig, {{MeshPoints{rig.neutral.points_mm}}});
  ASSERT_EQ(baked.result.rig.shapes.size(), 1u);
  EXPECT_TRUE(baked.result.rig.shapes[0].vertices.empty());
  EXPECT_EQ(baked.weights[0].values, std::vector<float>{0});
}

TEST(BakeShapes, IsAtRestWhereNoFrameHasVertices) {
  const Baked baked = bake(rig_at_rest(), {{MeshPoints{}, MeshPoints{}}});
  EXPECT_EQ(baked.result.rig.shapes.size(), 1u);
  EXPECT_EQ(baked.weights.size(), 2u);
}

TEST(BakeShapes, RejectsFramesOfAnotherMesh) {
  EXPECT_THROW_TEXT(bake(rig_at_rest(), {{MeshPoints{{{0, 0, 0}}}}}), "frame 0 has 1 vertices, expected 40 as the rig");
}
