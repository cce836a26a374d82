// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_head.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "tests/nodes/phantom/head_probe.h"

namespace {

using face::Rig;
using face::Vec3f;
using namespace probe;

TEST(MakeHead, IsTheSameEveryTime) {
  const Rig a = face::phantom::make_head(), b = face::phantom::make_head();
  EXPECT_EQ(a.neutral.points_mm, b.neutral.points_mm);
  EXPECT_EQ(a.neutral.corners, b.neutral.corners);
  EXPECT_EQ(a.neutral.colors_srgb, b.neutral.colors_srgb);
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (std::size_t s = 0; s < a.shapes.size(); ++s) EXPECT_EQ(a.shapes[s].offsets_mm, b.shapes[s].offsets_mm);
}

TEST(MakeHead, HasAtLeastFiveThousandVerticesMostlyInQuads) {
  const face::Mesh& mesh = head().neutral;
  EXPECT_GE(mesh.points_mm.size(), 5000u);
  std::size_t quads = 0;
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f)
    quads += mesh.polygon_starts[f + 1] - mesh.polygon_starts[f] == 4;
  EXPECT_GE(static_cast<double>(quads), 0.9 * static_cast<double>(mesh.polygon_count()));
}

TEST(MakeHead, IsAValidMesh) {
  const face::Mesh& mesh = head().neutral;
  ASSERT_FALSE(mesh.polygon_starts.empty());
  EXPECT_EQ(mesh.polygon_starts.front(), 0u);
  EXPECT_EQ(mesh.polygon_starts.back(), mesh.corners.size());
  EXPECT_EQ(mesh.colors_srgb.size(), mesh.points_mm.size());
  std::set<std::uint32_t> used;
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f) {
    std::set<std::uint32_t> corners;
    std::set<Vec3f> places;
    for (std::uint32_t i = mesh.polygon_starts[f]; i < mesh.polygon_starts[f + 1]; ++i) {
      ASSERT_LT(mesh.corners[i], mesh.points_mm.size());
      corners.insert(mesh.corners[i]);
      places.insert(mesh.points_mm[mesh.corners[i]]);
      used.insert(mesh.corners[i]);
    }
    const std::size_t size = mesh.polygon_starts[f + 1] - mesh.polygon_starts[f];
    EXPECT_TRUE(size == 3 || size == 4) << "polygon " << f << " has " << size << " corners";
    EXPECT_EQ(corners.size(), size) << "polygon " << f << " of part " << part_of(f) << " repeats a vertex";
    EXPECT_EQ(places.size(), size) << "polygon " << f << " of part " << part_of(f) << " has two corners in one place";
  }
  EXPECT_EQ(used.size(), mesh.points_mm.size()) << "every vertex belongs to a polygon";
  for (const Vec3f& p : mesh.points_mm)
    for (const float x : p) EXPECT_TRUE(std::isfinite(x));
  for (const Vec3f& c : mesh.colors_srgb)
    for (const float x : c) EXPECT_TRUE(x >= 0 && x <= 1) << x;
}

TEST(MakeHead, HasPartsThatTileThePolygons) {
  const face::Mesh& mesh = head().neutral;
  std::uint32_t next = 0;
  std::set<std::string> names;
  for (const face::Part& part : mesh.parts) {
    EXPECT_EQ(part.first_polygon, next) << part.name;
    EXPECT_GT(part.polygon_count, 0u) << part.name;
    EXPECT_TRUE(names.insert(part.name).second) << part.name << " occurs twice";
    next += part.polygon_count;
  }
  EXPECT_EQ(next, mesh.polygon_count());
  for (const char* name : {"face", "mouth_socket", "gums", "teeth", "tongue", "sclera_left", "sclera_right",
                           "iris_left", "iris_right", "brows", "lashes"})
    EXPECT_TRUE(names.count(name)) << name;
}

TEST(MakeHead, LooksToTheViewerFromAHeadOfNaturalSize) {
  const Rig& rig = head();
  float low = 1e9f, high = -1e9f;
  for (const std::uint32_t v : part_vertices("face")) high = std::max(high, rig.neutral.points_mm[v][1]);
  low = rig.neutral.points_mm[rig.landmarks68[8]][1];
  EXPECT_NEAR(high - low, 225, 12);  // chin to crown
  const auto middle = [&](const char* iris) {
    double x = 0;
    const std::vector<std::uint32_t> vertices = part_vertices(iris);
    for (const std::uint32_t v : vertices) x += rig.neutral.points_mm[v][0];
    return x / static_cast<double>(vertices.size());
  };
  EXPECT_NEAR(middle("iris_left") - middle("iris_right"), 62, 0.5);
}

TEST(MakeHead, HasPolygonsThatFaceOutwards) {
  // Seen along the line from a part's middle, the signed volume under its polygons is positive.
  for (const char* name : {"face", "teeth", "tongue", "sclera_left", "sclera_right", "hair"})
    EXPECT_GT(signed_volume(name), 0) << name;
}

TEST(MakeHead, GoesBaldWhenAsked) {
  face::phantom::MakeHeadOptions options;
  options.with_hair = false;
  const Rig bald = face::phantom::make_head(options);
  EXPECT_LT(bald.neutral.points_mm.size(), head().neutral.points_mm.size());
  for (const face::Part& part : bald.neutral.parts) EXPECT_NE(part.name, "hair");
  EXPECT_EQ(bald.shapes[17].offsets_mm, head().shapes[17].offsets_mm);
}

TEST(MakeHead, HasTheSixtyEightLandmarksInMultiPieOrder) {
  const Rig& rig = head();
  ASSERT_EQ(rig.landmarks68.size(), 68u);
  const auto at = [&](std::size_t k) { return rig.neutral.points_mm[rig.landmarks68[k]]; };
  EXPECT_EQ(std::set<std::uint32_t>(rig.landmarks68.begin(), rig.landmarks68.end()).size(), 68u);
  for (std::size_t k = 0; k < 16; ++k) EXPECT_LT(at(k)[0], at(k + 1)[0]) << "jaw line " << k;
  for (std::size_t k = 17; k < 26; ++k) EXPECT_LT(at(k)[0], at(k + 1)[0]) << "brows " << k;
  for (std::size_t k = 27; k < 30; ++k) EXPECT_GT(at(k)[1], at(k + 1)[1]) << "nose " << k;
  for (std::size_t k = 31; k < 35; ++k) EXPECT_LT(at(k)[0], at(k + 1)[0]) << "nose foot " << k;
  for (const std::size_t first : {36u, 42u}) {
    EXPECT_LT(at(first)[0], at(first + 3)[0]);
    EXPECT_GT(at(first + 1)[1], at(first + 5)[1]);
    EXPECT_GT(at(first + 2)[1], at(first + 4)[1]);
  }
  for (std::size_t k = 48; k < 54; ++k) EXPECT_LT(at(k)[0], at(k + 1)[0]) << "upper lip " << k;
  for (std::size_t k = 54; k < 59; ++k) EXPECT_GT(at(k)[0], at(k + 1)[0]) << "lower lip " << k;
  for (const auto& [upper, lower] : {std::pair{61, 67}, std::pair{62, 66}, std::pair{63, 65}})
    EXPECT_LT(distance(at(static_cast<std::size_t>(upper)), at(static_cast<std::size_t>(lower))), 0.01);
  // Mirror pairs of the 68.
  for (const auto& [right, left] :
       {std::pair{0, 16}, std::pair{7, 9}, std::pair{17, 26}, std::pair{21, 22}, std::pair{31, 35}, std::pair{36, 45},
        std::pair{37, 44}, std::pair{39, 42}, std::pair{41, 46}, std::pair{48, 54}, std::pair{50, 52},
        std::pair{59, 55}, std::pair{60, 64}, std::pair{67, 65}}) {
    const Vec3f a = at(static_cast<std::size_t>(right)), b = at(static_cast<std::size_t>(left));
    EXPECT_EQ((Vec3f{-a[0], a[1], a[2]}), b) << right << " and " << left;
  }
}

}  // namespace
