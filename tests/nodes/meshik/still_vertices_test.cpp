// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/still_vertices.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/expect_throw_text.h"

namespace face::meshik {
namespace {

// A strip of 20 x 2 vertices, 1 mm apart, and a triangle of its own far away.
Mesh strip() {
  Mesh mesh;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 2; ++y) mesh.points_mm.push_back({static_cast<float>(x), static_cast<float>(y), 0});
  for (int x = 0; x < 3; ++x) mesh.points_mm.push_back({static_cast<float>(x), static_cast<float>(x % 2), 90});
  mesh.polygon_starts = {0};
  const auto polygon = [&](std::vector<std::uint32_t> corners) {
    mesh.corners.insert(mesh.corners.end(), corners.begin(), corners.end());
    mesh.polygon_starts.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
  };
  for (std::uint32_t x = 0; x < 19; ++x) polygon({2 * x, 2 * x + 2, 2 * x + 3, 2 * x + 1});
  polygon({40, 41, 42});
  return mesh;
}
// The strip's first vertices moved.
Mesh lifted(std::size_t count) {
  Mesh mesh = strip();
  for (std::size_t v = 0; v < count; ++v) mesh.points_mm[v][2] = 1;
  return mesh;
}
engine::Seq<Mesh> examples() { return {std::vector<Mesh>{lifted(4), lifted(10)}}; }

TEST(StillVertices, AreThoseThatNoExampleMoves) {
  const VertexTargets all = still_vertices(strip(), examples(), {100, 0.02});
  std::set<std::uint32_t> found;
  for (const VertexTarget& target : all.targets) {
    found.insert(target.vertex);
    EXPECT_TRUE(target.has_z);
    EXPECT_EQ(target.x_mm, static_cast<double>(strip().points_mm[target.vertex][0]));
    EXPECT_EQ(target.y_mm, static_cast<double>(strip().points_mm[target.vertex][1]));
    EXPECT_EQ(target.z_mm, 0);
  }
  // Not the triangle of its own, in which nothing moves.
  EXPECT_EQ(found.size(), 30u);
  EXPECT_EQ(*found.begin(), 10u);
  EXPECT_EQ(*found.rbegin(), 39u);
}

TEST(StillVertices, AreSpreadFarApart) {
  const VertexTargets few = still_vertices(strip(), examples(), {3, 0.02});
  ASSERT_EQ(few.targets.size(), 3u);
  // The two ends of what stands still and its middle.
  EXPECT_EQ(few.targets[0].x_mm, 5);
  EXPECT_NEAR(few.targets[1].x_mm, 12, 1);
  EXPECT_EQ(few.targets[2].x_mm, 19);
}

TEST(StillVertices, AreNoneWhereEverythingOrNothingMoves) {
  EXPECT_TRUE(still_vertices(strip(), std::vector<Mesh>{lifted(40)}).targets.empty());
  EXPECT_TRUE(still_vertices(strip(), std::vector<Mesh>{}).targets.empty());
}

TEST(StillVertices, AVertexThatMovesALittleStandsStill) {
  Mesh slight = strip();
  slight.points_mm[39][0] += 0.01f;
  slight.points_mm[0][0] += 1;
  const auto holds = [](const VertexTargets& targets) { return targets.targets.back().vertex == 39; };
  EXPECT_TRUE(holds(still_vertices(strip(), std::vector<Mesh>{slight}, {100, 0.02})));
  EXPECT_FALSE(holds(still_vertices(strip(), std::vector<Mesh>{slight}, {100, 0.001})));
}

TEST(StillVertices, RejectsAnotherMesh) {
  Mesh short_one = strip();
  short_one.points_mm.pop_back();
  EXPECT_THROW_TEXT(still_vertices(strip(), std::vector<Mesh>{short_one}),
                    "example 0 has 42 vertices, the reference has 43");
}

}  // namespace
}  // namespace face::meshik
