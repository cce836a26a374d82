// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/vertex_graph.h"

#include <gtest/gtest.h>

using namespace face;
using namespace face::texture;

namespace {

std::vector<std::uint32_t> list(const Neighbours& neighbours, std::size_t v) {
  const auto of = neighbours.of(v);
  return {of.begin(), of.end()};
}

TEST(VertexGraph, FindsWhatIsNearAndAcross) {
  const std::vector<Vec3f> points = {{-2, 0, 0}, {2, 0, 0}, {2, 1, 0}, {9, 0, 0}};
  const std::vector<bool> all(4, true);
  EXPECT_EQ(list(vertices_within(points, all, 1.5f), 1), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(mirrored_vertices(points, all), (std::vector<std::int32_t>{1, 0, 0, -1}));
  EXPECT_EQ(mirrored_vertices(points, {false, true, true, true}), (std::vector<std::int32_t>{-1, -1, -1, -1}));
}

TEST(VertexGraph, JoinsWhatLiesAtOnePlace) {
  Mesh mesh;  // two triangles whose common edge is there twice
  mesh.points_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.corners = {0, 1, 2, 3, 5, 4};
  mesh.polygon_starts = {0, 3, 6};
  const Neighbours neighbours = mesh_neighbours(mesh, std::vector<bool>(6, true));
  EXPECT_EQ(list(neighbours, 0), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(list(neighbours, 1), (std::vector<std::uint32_t>{0, 2, 3}));
}

TEST(VertexGraph, FillsALineStraight) {
  Mesh mesh;  // a strip of edges 0 - 1 - 2 - 3 - 4
  for (int i = 0; i < 5; ++i) mesh.points_mm.push_back({static_cast<float>(i), 0, 0});
  mesh.corners = {0, 1, 1, 2, 2, 3, 3, 4};
  mesh.polygon_starts = {0, 2, 4, 6, 8};
  HarmonicFill fill;
  fill.value = {{0, 0, 4}, {9, 9, 9}, {9, 9, 9}, {9, 9, 9}, {4, 0, 0}};
  fill.held = {1, 0, 0, 0, 1};
  fill_harmonically(mesh_neighbours(mesh, std::vector<bool>(5, true)), 0, fill);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(fill.value[i][0], static_cast<double>(i), 1e-6);
    EXPECT_NEAR(fill.value[i][1], 0, 1e-6);
    EXPECT_NEAR(fill.value[i][2], 4 - static_cast<double>(i), 1e-6);
  }
}

}  // namespace
