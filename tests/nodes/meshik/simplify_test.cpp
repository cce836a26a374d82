// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "nodes/meshik/bind_surface.h"
#include "nodes/meshik/carry_fine.h"
#include "nodes/meshik/collapse_set.h"
#include "nodes/meshik/mesh_triangles.h"
#include "nodes/meshik/prepare.h"
#include "nodes/meshik/reconstruct.h"
#include "tests/nodes/meshik/bent_sheet.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::meshik;

constexpr std::size_t columns = 31, rows = 29;

const test::BentSheet& sheet() {
  static const test::BentSheet made = test::bent_sheet(columns, rows, 4);
  return made;
}

Mesh mesh_of(const std::vector<double>& points) {
  Mesh mesh;
  mesh.points_mm = points_of(points);
  mesh.corners = sheet().triangles;
  for (std::size_t i = 0; i <= mesh.corners.size(); i += 3)
    mesh.polygon_starts.push_back(static_cast<std::uint32_t>(i));
  return mesh;
}

// The 68 landmarks lie about the middle; the mouth's and the eyes' alike.
Rig rig() {
  Rig made;
  made.neutral = mesh_of(sheet().reference_mm);
  const auto polygons = static_cast<std::uint32_t>(made.neutral.polygon_count());
  made.neutral.parts = {{"upper", 0, polygons / 2, {1, 0, 0}, 0, true},
                        {"lower", polygons / 2, polygons - polygons / 2, {0, 1, 0}, 0, true}};
  for (std::uint32_t i = 0; i < 68; ++i) made.landmarks68.push_back((rows / 2) * columns + 12 + i % 7);
  made.inner_lips = {{5, 6}};
  made.shapes = {{"lift", {7, 6 * columns + 3}, {{0, 0, 1}, {0, 0, 2}}}};
  return made;
}
std::vector<Mesh> examples() {
  std::vector<Mesh> made;
  for (const std::vector<double>& pose : sheet().examples_mm) made.push_back(mesh_of(pose));
  return made;
}

struct Simplified {
  SimplifyResult result;
  std::vector<Mesh> examples;
};
Simplified simplified(const SimplifyOptions& options) {
  Simplified made;
  engine::SeqWriter<Mesh> writer([&](std::string, Mesh mesh) { made.examples.push_back(std::move(mesh)); });
  made.result = simplify(rig(), examples(), writer, options);
  return made;
}

bool same(const Vec3f& a, const Vec3f& b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

TEST(Simplify, LeavesVerticesWhereTheyAreInEveryPose) {
  const Simplified found = simplified({300, 0, 10});
  const Mesh& simple = found.result.rig.neutral;
  EXPECT_EQ(simple.points_mm.size(), 300u);
  EXPECT_EQ(found.result.triangles, static_cast<std::int64_t>(simple.polygon_count()));
  ASSERT_EQ(found.examples.size(), 4u);
  for (std::size_t v = 0; v < simple.points_mm.size(); ++v) {
    const auto& whole = rig().neutral.points_mm;
    const auto at =
        std::find_if(whole.begin(), whole.end(), [&](const Vec3f& p) { return same(p, simple.points_mm[v]); });
    ASSERT_NE(at, whole.end()) << v;
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_TRUE(
          same(found.examples[k].points_mm[v], examples()[k].points_mm[static_cast<std::size_t>(at - whole.begin())]));
  }
  EXPECT_EQ(found.examples[0].corners, simple.corners);
}

TEST(Simplify, KeepsLandmarksLipsShapesAndParts) {
  const Rig& simple = simplified({200, 0, 10}).result.rig;
  ASSERT_EQ(simple.landmarks68.size(), 68u);
  for (std::size_t i = 0; i < 68; ++i)
    EXPECT_TRUE(same(simple.neutral.points_mm[simple.landmarks68[i]], rig().neutral.points_mm[rig().landmarks68[i]]));
  ASSERT_EQ(simple.inner_lips.size(), 1u);
  EXPECT_TRUE(same(simple.neutral.points_mm[simple.inner_lips[0].upper], rig().neutral.points_mm[5]));
  ASSERT_EQ(simple.neutral.parts.size(), 2u);
  EXPECT_EQ(simple.neutral.parts[0].name, "upper");
  EXPECT_EQ(simple.neutral.parts[0].polygon_count + simple.neutral.parts[1].polygon_count,
            simple.neutral.polygon_count());
  ASSERT_EQ(simple.shapes.size(), 1u);
  EXPECT_EQ(simple.shapes[0].vertices.size(), simple.shapes[0].offsets_mm.size());
}

TEST(Simplify, IsNearTheSurfaceInEveryPose) {
  const Simplified found = simplified({250, 0, 10});
  // Every vertex of the whole sheet against its place on the simplified one: 899 vertices to 250 on a sheet of 200 mm.
  for (std::size_t k = 0; k < 4; ++k) {
    double squares = 0;
    for (std::size_t v = 0; v < found.result.binding.rows; ++v)
      for (std::size_t d = 0; d < 3; ++d) {
        double at = 0;
        for (std::size_t c = 0; c < 3; ++c)
          at += found.result.binding.at(v, 3 + c) *
                static_cast<double>(
                    found.examples[k].points_mm[static_cast<std::size_t>(found.result.binding.at(v, c))][d]);
        squares += std::pow(at - static_cast<double>(examples()[k].points_mm[v][d]), 2);
      }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(found.result.binding.rows)), 1.0) << k;
  }
}

TEST(Simplify, KeepsDetailAtEyesAndLips) {
  const auto near = [](const Rig& head) {
    const Vec3f& middle = rig().neutral.points_mm[rig().landmarks68[3]];
    return std::count_if(head.neutral.points_mm.begin(), head.neutral.points_mm.end(),
                         [&](const Vec3f& p) { return std::hypot(p[0] - middle[0], p[1] - middle[1]) < 25; });
  };
  EXPECT_GT(near(simplified({200, 100, 15}).result.rig), 2 * near(simplified({200, 0, 15}).result.rig));
}

TEST(Simplify, OfAFlatSheetKeepsItsOutline) {
  CollapseSet set;
  set.triangles = sheet().triangles;
  set.poses_mm.emplace_back();
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x)
      set.poses_mm[0].push_back({static_cast<float>(x), static_cast<float>(y), 0});
  set.importance.assign(columns * rows, 1);
  set.keep.assign(columns * rows, 0);
  const Collapsed found = collapse_set(set, 4);
  double area = 0;
  std::set<std::uint32_t> used(found.triangles.begin(), found.triangles.end());
  for (std::size_t t = 0; t < found.triangles.size(); t += 3) {
    const Vec3f &a = set.poses_mm[0][found.triangles[t]], &b = set.poses_mm[0][found.triangles[t + 1]],
                &c = set.poses_mm[0][found.triangles[t + 2]];
    area += static_cast<double>((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  EXPECT_EQ(used.size(), 4u);
  EXPECT_NEAR(std::abs(area), static_cast<double>((columns - 1) * (rows - 1)), 1e-6);
}

TEST(Simplify, TrianglesThatAreNoSurfaceStay) {
  CollapseSet set;
  set.triangles = sheet().triangles;
  set.poses_mm = {points_of(sheet().reference_mm)};
  // A third triangle at an edge.
  set.poses_mm[0].push_back({0, 0, 500});
  const auto last = static_cast<std::uint32_t>(set.poses_mm[0].size() - 1);
  set.triangles.insert(set.triangles.end(), {0, 1, last});
  set.importance.assign(set.poses_mm[0].size(), 1);
  set.keep.assign(set.poses_mm[0].size(), 0);
  const Collapsed found = collapse_set(set, 100);
  EXPECT_EQ(std::count(found.triangles.begin(), found.triangles.end(), last), 1);
  EXPECT_TRUE(std::is_sorted(found.faces.begin(), found.faces.end()));
  EXPECT_EQ(found.faces.back(), set.triangles.size() / 3 - 1);
}

TEST(Simplify, OfASmallMeshIsTheMesh) {
  const Simplified found = simplified({100000, 0, 10});
  EXPECT_EQ(found.result.rig.neutral.points_mm, rig().neutral.points_mm);
  EXPECT_EQ(found.result.rig.neutral.polygon_count(), rig().neutral.polygon_count());
}

TEST(Simplify, RejectsAnotherMesh) {
  std::vector<Mesh> wrong = examples();
  wrong[1].points_mm.pop_back();
  engine::SeqWriter<Mesh> nowhere([](std::string, Mesh) {});
  EXPECT_THROW_TEXT(simplify(rig(), wrong, nowhere), "example 1 has 898 vertices, the rig has 899");
  EXPECT_THROW_TEXT(simplify(Rig{}, std::vector<Mesh>{}, nowhere), "the rig has no vertices");
}

TEST(BindSurface, OfAPartThatIsGoneHasNoShares) {
  // Two triangles; the coarse surface has the first one alone.
  const std::vector<Vec3f> points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 9}, {1, 0, 9}, {0, 1, 9}};
  const Matrix binding = bind_surface(points, {0, 1, 2, 3, 4, 5}, {0, 1, 2});
  EXPECT_EQ(binding.at(1, 0), 1);
  EXPECT_EQ(binding.at(1, 3), 1);
  for (std::size_t v = 3; v < 6; ++v) EXPECT_EQ(binding.at(v, 3) + binding.at(v, 4) + binding.at(v, 5), 0);
}

TEST(CarryFine, OfABlendIsTheWholeHeadsBlend) {
  const Simplified found = simplified({250, 0, 10});
  const MeshSpace space = prepare(rig().neutral, examples());
  const MeshSpace simple = prepare(found.result.rig.neutral, found.examples);
  const Weights weights{{0.3f, 0, 0.5f, 0.1f}};
  const MeshPoints whole = reconstruct(space, weights);
  const MeshPoints carried = carry_fine(space, simple, found.result.binding, weights, reconstruct(simple, weights));
  for (std::size_t v = 0; v < whole.points_mm.size(); ++v)
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(carried.points_mm[v][d], whole.points_mm[v][d], 1e-4);
}

TEST(CarryFine, TakesAlongWhatTheSimpleHeadMovedBeyondItsBlend) {
  const Simplified found = simplified({250, 0, 10});
  const MeshSpace space = prepare(rig().neutral, examples());
  const MeshSpace simple = prepare(found.result.rig.neutral, found.examples);
  const Weights weights{{0, 0, 0, 0}};
  MeshPoints points = reconstruct(simple, weights);
  for (Vec3f& p : points.points_mm) p[1] += 2;
  const MeshPoints carried = carry_fine(space, simple, found.result.binding, weights, points);
  for (std::size_t v = 0; v < carried.points_mm.size(); ++v)
    EXPECT_NEAR(carried.points_mm[v][1], rig().neutral.points_mm[v][1] + 2, 1e-3);
  EXPECT_TRUE(carry_fine(space, simple, found.result.binding, {}, {}).points_mm.empty());
  EXPECT_THROW_TEXT(carry_fine(space, simple, Matrix{}, weights, points), "binding is 0 x 0, expected 899 x 6");
  points.points_mm.pop_back();
  EXPECT_THROW_TEXT(carry_fine(space, simple, found.result.binding, weights, points),
                    "there are 249 points, the simplified head has 250 vertices");
}

}  // namespace
