// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/rasterize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "nodes/base/random.h"
#include "tests/support/expect_throw_text.h"

namespace face::render {
namespace {

RasterOptions picture(int width_px, int height_px, Culling culling = Culling::none) {
  RasterOptions options;
  options.width_px = width_px;
  options.height_px = height_px;
  options.culling = culling;
  return options;
}

int covered(const Raster& raster) {
  int count = 0;
  for (const std::int32_t id : raster.triangles) count += id >= 0;
  return count;
}

TEST(Rasterize, CoversExactlyThePixelCentresInsideATriangle) {
  // The right angle is at (0, 0); centres with x + y < 8 are inside, the diagonal (a right edge) is not.
  const Raster raster = rasterize({{0, 0, 10}, {8, 0, 10}, {0, 8, 10}}, {{0, 1, 2}}, picture(10, 10));
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 10; ++x) EXPECT_EQ(raster.triangles[raster.index(x, y)] == 0, x + y < 8) << x << ", " << y;
}

TEST(Rasterize, GivesEveryPixelOfAFanToExactlyOneTriangle) {
  // A square cut into triangles about an odd inner point: each pixel is drawn once, none is left out.
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    std::vector<ScreenPoint> points = {{0, 0, 10}, {32, 0, 10}, {32, 32, 10}, {0, 32, 10}};
    points.push_back({static_cast<float>(random.uniform(1, 31)), static_cast<float>(random.uniform(1, 31)), 10});
    if (seed == 0) points[4] = {16, 16, 10};  // edges straight through pixel centres
    int total = 0;
    for (std::uint32_t i = 0; i < 4; ++i) total += covered(rasterize(points, {{i, (i + 1) % 4, 4}}, picture(40, 40)));
    EXPECT_EQ(total, 32 * 32) << "seed " << seed;
  }
}

TEST(Rasterize, GivesTheSamePixelsToSmallAndToLargeTriangles) {
  // 32-bit and 64-bit edge functions: one large triangle equals its four quarters.
  const std::vector<ScreenPoint> points = {{3, 5, 10},    {403, 25, 10},  {103, 385, 10},
                                           {203, 15, 10}, {253, 205, 10}, {53, 195, 10}};
  const Raster whole = rasterize(points, {{0, 1, 2}}, picture(450, 400));
  const Raster quarters = rasterize(points, {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}, picture(450, 400));
  for (std::size_t i = 0; i < whole.triangles.size(); ++i)
    ASSERT_EQ(whole.triangles[i] >= 0, quarters.triangles[i] >= 0) << "pixel " << i;
}

TEST(Rasterize, KeepsTheNearestTriangleInAnyOrder) {
  const std::vector<ScreenPoint> points = {{0, 0, 20}, {8, 0, 20}, {0, 8, 20}, {0, 0, 10}, {8, 0, 10}, {0, 8, 10}};
  const Raster far_first = rasterize(points, {{0, 1, 2}, {3, 4, 5}}, picture(8, 8));
  const Raster near_first = rasterize(points, {{3, 4, 5}, {0, 1, 2}}, picture(8, 8));
  EXPECT_EQ(far_first.triangles[far_first.index(1, 1)], 1);
  EXPECT_EQ(near_first.triangles[near_first.index(1, 1)], 0);
  EXPECT_NEAR(1 / far_first.inverse_depth_per_mm[far_first.index(1, 1)], 10, 1e-5);
}

TEST(Rasterize, DropsBackFacesWhenAsked) {
  const std::vector<ScreenPoint> points = {{0, 0, 10}, {8, 0, 10}, {0, 8, 10}};
  // (0, 0), (0, 8), (8, 0) runs counter-clockwise as one sees it.
  EXPECT_EQ(covered(rasterize(points, {{0, 2, 1}}, picture(8, 8, Culling::back))), 36);
  EXPECT_EQ(covered(rasterize(points, {{0, 1, 2}}, picture(8, 8, Culling::back))), 0);
}

TEST(Rasterize, InterpolatesDepthInPerspective) {
  // A plane that recedes from 100 to 200 mm: half way in the picture the depth is the harmonic mean.
  const std::vector<ScreenPoint> points = {{0, 0, 100}, {64, 0, 200}, {0, 64, 100}, {64, 64, 200}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {2, 1, 3}};
  const Raster raster = rasterize(points, triangles, picture(64, 64));
  EXPECT_NEAR(1 / raster.inverse_depth_per_mm[raster.index(32, 16)], 2 / (1 / 100.0 + 1 / 200.0), 1e-3);
  const std::vector<Vec3f> barycentrics = barycentrics_of(raster, points, triangles);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::size_t pixel = raster.index(x, y);
      const Triangle& triangle = triangles[static_cast<std::size_t>(raster.triangles[pixel])];
      float sum = 0, depth_mm = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GE(barycentrics[pixel][i], -1e-5f);
        sum += barycentrics[pixel][i];
        depth_mm += barycentrics[pixel][i] * points[triangle[i]].depth_mm;
      }
      EXPECT_NEAR(sum, 1, 1e-5);
      EXPECT_NEAR(depth_mm * raster.inverse_depth_per_mm[pixel], 1, 1e-4);
    }
}

TEST(Rasterize, LeavesOutWhatIsBehindTheCameraOrNotANumber) {
  const float nan = std::nanf("");
  EXPECT_EQ(covered(rasterize({{0, 0, 10}, {8, 0, -5}, {0, 8, 10}}, {{0, 1, 2}}, picture(8, 8))), 0);
  EXPECT_EQ(covered(rasterize({{nan, 0, 10}, {8, 0, 10}, {0, 8, 10}}, {{0, 1, 2}}, picture(8, 8))), 0);
  EXPECT_EQ(covered(rasterize({{0, 0, nan}, {8, 0, 10}, {0, 8, 10}}, {{0, 1, 2}}, picture(8, 8))), 0);
  EXPECT_EQ(covered(rasterize({{1, 1, 10}, {5, 1, 10}, {3, 1, 10}}, {{0, 1, 2}}, picture(8, 8))), 0);
}

TEST(Rasterize, CutsTrianglesAtThePicturesEdge) {
  const Raster raster =
      rasterize({{-1000, -1000, 10}, {3000, -1000, 10}, {-1000, 3000, 10}}, {{0, 1, 2}}, picture(7, 5));
  EXPECT_EQ(covered(raster), 35);
}

TEST(Rasterize, IsTheSameFromManyThreadsAtOnce) {
  Random random(7);
  std::vector<ScreenPoint> points;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < 3000; ++i)
    points.push_back({static_cast<float>(random.uniform(-10, 200)), static_cast<float>(random.uniform(-10, 200)),
                      static_cast<float>(random.uniform(50, 100))});
  for (std::uint32_t i = 0; i + 2 < 3000; ++i) triangles.push_back({i, i + 1, i + 2});
  const Raster expected = rasterize(points, triangles, picture(190, 190));
  std::vector<Raster> results(4);
  std::vector<std::thread> threads;
  for (Raster& result : results)
    threads.emplace_back([&] { result = rasterize(points, triangles, picture(190, 190)); });
  for (std::thread& thread : threads) thread.join();
  for (const Raster& result : results) {
    EXPECT_EQ(result.triangles, expected.triangles);
    EXPECT_EQ(result.inverse_depth_per_mm, expected.inverse_depth_per_mm);
  }
}

TEST(Rasterize, RejectsAVertexThatIsNotThere) {
  EXPECT_THROW_TEXT(rasterize({{0, 0, 1}}, {{0, 0, 3}}), "triangle 0 uses vertex 3 of 1");
  EXPECT_THROW_TEXT(rasterize({}, {}, picture(0, 5)), "the picture is 0 x 5 pixels, expected at least 1 x 1");
}

}  // namespace
}  // namespace face::render
