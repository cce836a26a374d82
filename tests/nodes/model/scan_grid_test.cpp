// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/scan_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "nodes/model/sample_scan.h"
#include "tests/support/expect_throw_text.h"

namespace face::model {
namespace {

constexpr int side = 80;

// A wall 500 mm away, 0.5 mm per pixel, measured where `measured` says so.
DepthScan wall(const std::function<bool(int, int)>& measured) {
  DepthScan scan;
  scan.camera.focal_px = 1000;
  scan.camera.centre_x_px = scan.camera.centre_y_px = side / 2;
  scan.camera.position_mm = {0, 0, 500};
  scan.camera.cam_from_world = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  scan.picture = {side, side, 1, std::vector<std::uint8_t>(side * side, 128)};
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) scan.depth_mm.push_back(measured(x, y) ? 500.0f : 0.0f);
  return scan;
}

// Places of the vertices on the mesh's edge.
std::vector<Vec2f> outline(const ScanGrid& grid) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : grid.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  std::vector<Vec2f> places;
  for (const auto& [edge, count] : uses)
    if (count == 1) places.insert(places.end(), {grid.place_px[edge.first], grid.place_px[edge.second]});
  return places;
}

TEST(ScanGrid, HasARoundEdgeWhereTheScanIsRound) {
  constexpr double radius_px = 30.3;
  const auto distance = [](double x, double y) { return std::hypot(x - 40, y - 40); };
  const DepthScan scan = wall([&](int x, int y) { return distance(x, y) <= radius_px; });
  const ScanGrid grid = scan_grid(scan, 2, 8);
  double squares = 0, stairs = 0, mean = 0;
  const std::vector<Vec2f> edge = outline(grid);
  for (const Vec2f& p : edge) mean += distance(p[0], p[1]) / static_cast<double>(edge.size());
  for (const Vec2f& p : edge) {
    const double rounded = distance(2 * std::round(p[0] / 2), 2 * std::round(p[1] / 2));
    squares += (distance(p[0], p[1]) - mean) * (distance(p[0], p[1]) - mean);
    stairs += (rounded - mean) * (rounded - mean);
  }
  EXPECT_GT(edge.size(), 100u);
  EXPECT_LT(squares, 0.15 * stairs);
  EXPECT_NEAR(mean, radius_px, 1.6);  // vertices are every second pixel
}

// Between the tip of a nose and the lip below it lie 12 mm of depth on neighbouring pixels of a small picture.
TEST(ScanGrid, HasNoSlitUnderANose) {
  DepthScan scan = wall([](int, int) { return true; });
  for (int y = 30; y < 40; ++y)
    for (int x = 30; x < 50; ++x) scan.depth_mm[static_cast<std::size_t>(side * y + x)] = 488;
  const ScanGrid grid = scan_grid(scan, 2, ScanMeshOptions().longest_edge_mm);
  for (const Vec2f& p : outline(grid)) EXPECT_FALSE(std::max(std::fabs(p[0] - 40), std::fabs(p[1] - 40)) < 30);
}

TEST(ScanGrid, KeepsInnerVerticesOnTheirPixelsAndAllOnMeasuredOnes) {
  const DepthScan scan = wall([](int x, int y) { return x >= 10 && x < 61 && y >= 20 + x / 5 && y < 60; });
  const ScanGrid grid = scan_grid(scan, 2, 8);
  const std::vector<Vec2f> edge = outline(grid);
  int inner = 0;
  for (std::size_t v = 0; v < grid.place_px.size(); ++v) {
    const Vec2f& p = grid.place_px[v];
    const auto x = static_cast<std::size_t>(std::lround(p[0])), y = static_cast<std::size_t>(std::lround(p[1]));
    EXPECT_GT(scan.depth_mm[y * side + x], 0);
    EXPECT_NEAR(grid.point_mm[v][0], 0.5f * (p[0] - 40), 1e-3);  // measured where it lies
    EXPECT_NEAR(grid.point_mm[v][1], 0.5f * (40 - p[1]), 1e-3);
    if (std::find(edge.begin(), edge.end(), p) != edge.end()) continue;
    ++inner;
    EXPECT_EQ(std::fmod(p[0], 2.0f), 0);
    EXPECT_EQ(std::fmod(p[1], 2.0f), 0);
  }
  EXPECT_GT(inner, 200);
}

TEST(ScanGrid, MakesOneTriangleOfThreeNeighboursWhicheverIsMissing) {
  for (int missing = 0; missing < 4; ++missing) {
    const auto there = [&](int x, int y) {
      return (x == 20 || x == 22) && (y == 20 || y == 22) && (x == 22 ? 1 : 0) + (y == 22 ? 2 : 0) != missing;
    };
    const ScanGrid grid = scan_grid(wall(there), 2, 8);
    ASSERT_EQ(grid.triangles.size(), 1u) << missing;
    const auto& t = grid.triangles[0];
    const Vec3f &a = grid.point_mm[t[0]], &b = grid.point_mm[t[1]], &c = grid.point_mm[t[2]];
    EXPECT_GT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0) << "it faces the camera";
  }
}

TEST(ScanGrid, HasNoTrianglesOverAStepAndNothingWithoutMeasurements) {
  DepthScan scan = wall([](int, int) { return true; });
  for (int y = 0; y < side; ++y)
    for (int x = 40; x < side; ++x) scan.depth_mm[static_cast<std::size_t>(y * side + x)] = 520;
  const ScanGrid stepped = scan_grid(scan, 2, 8);
  for (const auto& t : stepped.triangles) {
    const auto [least, most] =
        std::minmax({stepped.point_mm[t[0]][2], stepped.point_mm[t[1]][2], stepped.point_mm[t[2]][2]});
    ASSERT_EQ(least, most);
  }
  const ScanGrid empty = scan_grid(wall([](int, int) { return false; }), 2, 8);
  EXPECT_TRUE(empty.triangles.empty() && empty.place_px.empty());
  scan.depth_mm.pop_back();
  EXPECT_THROW_TEXT(scan_grid(scan, 2, 8), "reference has 6399 depths, its picture is 80 x 80 pixels");
}

}  // namespace
}  // namespace face::model
