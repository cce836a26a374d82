// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/start_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "nodes/model/pose_model.h"
#include "tests/nodes/model/material.h"

using namespace face;
using namespace face::model;

namespace {

// A head before a wall with a fine pattern, as if its skin had it.
struct World {
  SkinBasis basis = make_skin_basis(test::head_model(), 4, 4, 0);
  std::vector<double> identity = std::vector<double>(4, 0.3);
  Image picture = test::blank(240, 240);
  PictureState state;

  explicit World(double yaw_deg = 0) {
    for (int y = 0; y < 240; ++y)
      for (int x = 0; x < 240; ++x)
        for (int c = 0; c < 3; ++c)
          picture.pixels[static_cast<std::size_t>((y * 240 + x) * 3 + c)] =
              static_cast<std::uint8_t>(130 + 50 * std::sin(x * 1.1 + c) * std::cos(y * 0.9));
    state.pose = moved(test::pose_in_front(), {0, yaw_deg * 0.01745, 0, 0, 0, 0, 0});
    state.expression.assign(4, 0.2);
    state.light = {{0.5f, 0.6f, 0.7f}, {0.6f, 0.5f, 0.4f}, {0.3f, 0.4f, 0.866f}, 0.9f,
                   {1.1f, 1, 0.9f},    {0.01f, 0, 0.02f},  {0.02f, 0.03f}};
  }
  StartView view() const { return start_view(basis, identity, state, make_level(picture, 1)); }
  std::vector<Vec3f> posed_mm() const { return posed_skin(basis, identity, state.expression); }
};

// Vertices are 4 mm apart and the pattern's waves 6 pixels long: by the vertices' colours all of it would be missed.
TEST(StartView, ExplainsItsOwnPictureToThePixel) {
  const World world;
  const StartView view = world.view();
  Random random(1);
  std::size_t visible = 0;
  std::vector<SkinPoint> points = choose_points(world.basis, view.drawn, 500, random, visible);
  colour_points(view, world.basis, {}, points);
  std::erase_if(points, [](const SkinPoint& p) { return !p.albedo; });
  ASSERT_GT(points.size(), 300u);
  const PixelRows rows = rows_at(points, world.basis, world.posed_mm(), world.basis.mean_albedo, world.state,
                                 view.level, {0, 0, 0, false});
  for (const float residual : rows.residual) EXPECT_NEAR(residual, 0, 1e-3);
}

TEST(StartView, HasNoColoursOfSkinThatItDoesNotShow) {
  const World aside(50), front(0);
  const StartView view = aside.view();
  Random random(1);
  std::size_t visible = 0;
  std::vector<SkinPoint> points = choose_points(front.basis, front.view().drawn, 2000, random, visible);
  colour_points(view, front.basis, {}, points);
  int hidden = 0, hidden_coloured = 0, coloured = 0;
  for (const SkinPoint& point : points) {
    const float x = front.basis.mean_mm[front.basis.triangles[point.triangle][0]][0];
    coloured += point.albedo.has_value();
    EXPECT_EQ(point.mirrors, point.albedo.has_value());  // colours from elsewhere hold what they mirror
    if (x < 45) continue;                                // the side that turns away
    ++hidden;
    hidden_coloured += point.albedo.has_value();
  }
  ASSERT_GT(hidden, 30);
  EXPECT_LT(hidden_coloured, hidden / 10);
  EXPECT_GT(coloured, 500);
}

// The least reflectance in rows 118 to 123 of the picture, where skin is told to look 8 mm up as far as it has parted.
float darkest(const World& world, float parted) {
  const StartView view = world.view();
  const std::size_t vertices = world.basis.vertices.size();
  const LipRims rims{std::vector<float>(vertices, 8.0f), std::vector<float>(vertices, parted)};
  Random random(1);
  std::size_t visible = 0;
  std::vector<SkinPoint> points = choose_points(world.basis, view.drawn, 2000, random, visible);
  colour_points(view, world.basis, rims, points);
  float least = 1;
  for (const SkinPoint& point : points) {
    float y = 0;
    for (std::size_t i = 0; i < 3; ++i)
      y += point.weights[i] * view.drawn.screen[world.basis.triangles[point.triangle][i]].y_px;
    if (point.albedo && y > 118 && y < 123) least = std::min(least, (*point.albedo)[0]);
  }
  return least;
}

// The dark line between lips that meet is no colour of theirs.
TEST(StartView, GivesRimsTheColourOfTheirLipWhereLipsHaveParted) {
  World world;
  std::fill(world.picture.pixels.begin(), world.picture.pixels.end(), std::uint8_t{150});
  const float plain = darkest(world, 0);
  for (std::size_t i = 118u * 240 * 3; i < 124u * 240 * 3; ++i) world.picture.pixels[i] = 30;
  EXPECT_LT(darkest(world, 0), 0.2f * plain);
  EXPECT_GT(darkest(world, 1), 0.8f * plain);  // light falls otherwise 8 mm up
}

}  // namespace
