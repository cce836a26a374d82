// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/pixel_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/model/light_model.h"
#include "tests/nodes/model/material.h"

using namespace face;
using namespace face::model;

namespace {

struct World {
  SkinBasis basis = make_skin_basis(test::head_model(), 8, 4, 6);
  PictureLevel level;
  PictureState state;
  std::vector<double> identity = std::vector<double>(8, 0.3), albedo = std::vector<double>(6, 0.2);
  PixelColumns columns{8, 6, 4, true, true};
  std::vector<SkinPoint> points;

  World() {
    Image picture = test::blank(200, 200);
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x)
        for (int c = 0; c < 3; ++c)
          picture.pixels[static_cast<std::size_t>((y * 200 + x) * 3 + c)] =
              static_cast<std::uint8_t>(128 + 60 * std::sin(x * 0.07 + c) * std::cos(y * 0.05));
    level = make_level(picture, 0.7);
    const Vec3f centre = turning_point(test::head_model());
    for (std::size_t k = 0; k < 3; ++k) state.pose.centre_mm[k] = centre[k];
    state.pose.u_px = 100;
    state.pose.v_px = 105;
    state.pose.middle_x_px = state.pose.middle_y_px = 99.5;
    state.pose.log_scale = std::log(0.9);
    state.pose.log_focal = std::log(500);
    state.pose = moved(state.pose, {0.1, 0.4, -0.05, 0, 0, 0, 0});
    state.expression.assign(4, 0.2);
    state.light = {{0.5f, 0.6f, 0.7f}, {0.6f, 0.5f, 0.4f}, {0.5f, 0.4f, 0.7681f}, 0.9f,
                   {1.1f, 1, 0.9f},    {0.01f, 0, 0.02f},  {0.02f, 0.01f}};
    Random random(1);
    std::size_t visible = 0;
    points =
        choose_points(basis, posed_skin(basis, identity, state.expression), state.pose, level, 200, random, visible);
  }
  PixelRows rows() const {
    return rows_at(points, basis, posed_skin(basis, identity, state.expression), skin_albedo(basis, albedo), state,
                   level, columns);
  }
  World changed(std::size_t column, double step) const {
    World other = *this;
    if (column < 8) {
      other.identity[column] += step;
    } else if (column < 14) {
      other.albedo[column - 8] += step;
    } else if (column < 21) {
      std::array<double, FacePose::size> turn{};
      turn[column - 14] = step;
      other.state.pose = moved(state.pose, turn);
    } else if (column < 25) {
      other.state.expression[column - 21] += step;
    } else if (column >= columns.shading_first()) {
      other.state.shading[column - columns.shading_first()] += step;
    } else {
      std::array<double, light_parameters> light{};
      light[column - 25] = step;
      other.state.light = moved(state.light, light.data());
    }
    return other;
  }
};

TEST(PictureLevel, ColoursAreTheFirstOfItsSamplesAndTheEdgeGoesOn) {
  Image picture = test::blank(40, 30);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i] = static_cast<std::uint8_t>(i * i % 251);
  const PictureLevel level = make_level(picture, 0.7);
  const std::array<float, 3> corner = colour_at(level, 0, 0);
  EXPECT_EQ(colour_at(level, -7, -3), corner);
  for (const std::array<double, 2>& at : {std::array{0.0, 0.0}, {3.2, 17.9}, {26.8, 19.4}, {90.0, 5.5}}) {
    const std::array<float, 9> samples = sample_at(level, at[0], at[1]);
    EXPECT_EQ(colour_at(level, at[0], at[1]), (std::array{samples[0], samples[1], samples[2]})) << at[0];
  }
}

TEST(PixelRows, HasTheDerivativesThatDifferencesHave) {
  const World world;
  const PixelRows rows = world.rows();
  ASSERT_GT(rows.residual.size(), 300u);
  for (std::size_t column = 0; column < world.columns.size(); ++column) {
    const double step = column == 17 || column == 18 ? 0.2 : column >= 14 && column < 17 ? 2e-3 : 1e-2;
    const PixelRows up = world.changed(column, step).rows(), down = world.changed(column, -step).rows();
    if (up.residual.size() != rows.residual.size() || down.residual.size() != rows.residual.size()) continue;
    double error = 0, size = 0;
    for (std::size_t i = 0; i < rows.residual.size(); ++i) {
      const double difference = (up.residual[i] - down.residual[i]) / (2 * step);
      error += std::pow(difference - rows.jacobian[i * rows.columns + column], 2);
      size += difference * difference;
    }
    // Shape turns the smooth normal as it turns the triangle: alike but not equal. All else is exact but for floats.
    const bool shape = column < 8 || (column >= 21 && column < 25);
    EXPECT_LT(std::sqrt(error), (shape ? 0.35 : 0.01) * std::sqrt(size) + 1e-4) << "column " << column;
  }
}

// A highlight that no light of the model makes: what is brighter by the normal's direction alone is no difference.
TEST(PixelRows, ExplainSlowChangesOfBrightnessByShading) {
  World world;
  const std::size_t first = world.columns.shading_first();
  const PixelRows before = world.rows();
  world.state.shading = {0.02, 0.01, -0.03, 0.02, 0.01, 0, 0.01, -0.01, 0.005};
  const PixelRows after = world.rows();
  ASSERT_EQ(after.residual.size(), before.residual.size());
  for (std::size_t i = 0; i < after.residual.size(); ++i) {
    double expected = before.residual[i];
    for (std::size_t k = 0; k < shading_parameters; ++k)
      expected += world.state.shading[k] * before.jacobian[i * before.columns + first + k];
    EXPECT_NEAR(after.residual[i], expected, 1e-5);
  }
}

TEST(LightModel, IsUndoneExactly) {
  const World world;
  const std::array<double, 3> lit = {0.2, 0.5, 1.3};
  const std::array<double, 3> back = lit_of(world.state.light, shown(world.state.light, lit));
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(back[c], lit[c], 1e-9);
}

}  // namespace
