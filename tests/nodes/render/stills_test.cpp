// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nodes/render/flow_still.h"
#include "nodes/render/mesh_still.h"
#include "nodes/render/points_still.h"
#include "nodes/render/render_head.h"
#include "tests/nodes/render/test_ball.h"
#include "tests/support/expect_throw_text.h"

namespace face::render {
namespace {

// Columns [left, left + width) of a picture.
Image part_of(const Image& image, int left, int width) {
  Image out{width, image.height, 3, {}};
  for (int y = 0; y < image.height; ++y) {
    const auto first = image.pixels.begin() + (static_cast<std::ptrdiff_t>(y) * image.width + left) * 3;
    out.pixels.insert(out.pixels.end(), first, first + width * 3);
  }
  return out;
}

RenderHeadOptions side(double yaw_deg) {
  RenderHeadOptions options;
  options.width_px = options.height_px = 360;
  options.yaw_deg = yaw_deg;
  return options;
}

std::vector<std::uint8_t> pixel(const Image& image, int x, int y) {
  const auto at = image.pixels.begin() + (static_cast<std::ptrdiff_t>(y) * image.width + x) * 3;
  return {at, at + 3};
}

std::size_t lit(const Image& image) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < image.pixels.size(); i += 3) count += image.pixels[i] > 60;
  return count;
}

TEST(MeshStill, ShowsTheMeshFromTheFrontAndFromItsLeft) {
  const Rig ball = test::ball_rig(80);
  const Image still = mesh_still(ball.neutral);
  ASSERT_EQ(still.width, 720);
  EXPECT_EQ(part_of(still, 0, 360).pixels, render_head(ball, {}, side(0)).pixels);
  EXPECT_EQ(part_of(still, 360, 360).pixels, render_head(ball, {}, side(40)).pixels);
}

TEST(MeshStill, ShowsAMeshWithoutPolygonsAsDots) {
  Mesh mesh;
  mesh.points_mm = {{0, 0, 0}, {10, 0, 0}, {0, 10, 5}};
  EXPECT_EQ(mesh_still(mesh).pixels, points_still({mesh.points_mm}).pixels);
}

TEST(RigStill, OpensTheMouthInItsThirdPicture) {
  const Rig ball = test::ball_rig(80);
  const Image still = rig_still(ball);
  ASSERT_EQ(still.width, 3 * 360);
  EXPECT_EQ(part_of(still, 0, 360).pixels, render_head(ball, {}, side(0)).pixels);
  EXPECT_NE(part_of(still, 720, 360).pixels, part_of(still, 0, 360).pixels);
  Rig without = ball;
  without.shapes.clear();
  const Image plain = rig_still(without);
  EXPECT_EQ(part_of(plain, 720, 360).pixels, part_of(plain, 0, 360).pixels);
}

TEST(PointsStill, DrawsADotPerPointTheNearerTheBrighter) {
  const Image still = points_still({{{0, 0, 0}, {100, 0, 10}, {0, 100, 5}}});
  const Image front = part_of(still, 0, 360);
  EXPECT_EQ(lit(front), 3u * 4);
  EXPECT_EQ(pixel(front, 344, 344)[1], 250);  // the nearest, at the right, below
  EXPECT_EQ(pixel(front, 16, 344)[1], 70);
}

TEST(PointsStill, LeavesOutWhatIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(points_still({{{0, 0, 0}, {nan, 0, 0}, {0, 100, 5}}}).pixels,
            points_still({{{0, 0, 0}, {0, 100, 5}}}).pixels);
  EXPECT_EQ(lit(points_still({})), 0u);
}

TEST(LandmarksStill, FramesThePointsAtTheirOwnSize) {
  const Image still = landmarks_still({{{"a", 100, 50, true}, {"b", 140, 80, false}}});
  EXPECT_EQ(still.width, 40 + 32);
  EXPECT_EQ(still.height, 30 + 32);
  EXPECT_GT(pixel(still, 16, 16)[1], 200);  // green
  EXPECT_LT(pixel(still, 56, 46)[0], 60);   // the middle of a ring
  EXPECT_EQ(landmarks_still({}).width, 32);
  EXPECT_EQ(landmarks_still({{{"a", 0, 0, true}, {"b", 10000, 0, true}}}).width, 720);
}

TEST(FlowStill, ColoursDirectionAndLength) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Image still = flow_still({5, 1, {{2, 0}, {-2, 0}, {0, 0}, {1, 0}, {nan, 0}}, {1, 1, 1, 1, 1}});
  EXPECT_EQ(pixel(still, 0, 0), (std::vector<std::uint8_t>{255, 0, 0}));
  EXPECT_EQ(pixel(still, 1, 0), (std::vector<std::uint8_t>{0, 255, 255}));
  EXPECT_EQ(pixel(still, 2, 0), (std::vector<std::uint8_t>{255, 255, 255}));
  EXPECT_EQ(pixel(still, 3, 0), (std::vector<std::uint8_t>{255, 128, 128}));
  EXPECT_EQ(pixel(still, 4, 0), (std::vector<std::uint8_t>{0, 0, 0}));
  EXPECT_THROW_TEXT(flow_still({2, 1, {{0, 0}}, {1}}), "the flow of 2 x 1 pixels has 1 displacements and 1 flags");
}

}  // namespace
}  // namespace face::render
