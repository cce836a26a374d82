// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/fit_perspective.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/random.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

Matrix known() { return {3, 3, {1.02, 0.015, 3, -0.01, 0.99, -2, 2e-5, -1e-5, 1}}; }

std::vector<PointPair> pairs_of(const Matrix& h, double shift_px = 0) {
  std::vector<PointPair> pairs;
  for (int y = 0; y < 240; y += 8)
    for (int x = 0; x < 320; x += 8) {
      const auto [u, v] = map_point(h, x, y);
      pairs.push_back({x + shift_px, y + shift_px, u + shift_px, v + shift_px});
    }
  return pairs;
}

// The largest distance of where two perspectives take a picture's corners.
double apart_px(const Matrix& a, const Matrix& b) {
  double most = 0;
  for (const double x : {0.0, 319.0})
    for (const double y : {0.0, 239.0}) {
      const auto p = map_point(a, x, y), q = map_point(b, x, y);
      most = std::max(most, std::hypot(p[0] - q[0], p[1] - q[1]));
    }
  return most;
}

TEST(FitPerspective, RecoversAKnownPerspective) {
  const FitPerspectiveResult fit = fit_points(pairs_of(known()));
  EXPECT_TRUE(fit.solved);
  EXPECT_LT(apart_px(fit.target_from_reference, known()), 1e-6);
  EXPECT_LT(fit.rms_px, 1e-6);
}

TEST(FitPerspective, IsNotMovedByAThirdOfThePointsThatMoveOtherwise) {
  std::vector<PointPair> pairs = pairs_of(known());
  Random random(3);
  for (PointPair& p : pairs) {
    p.to_x += 0.05 * random.normal(), p.to_y += 0.05 * random.normal();
    if (random.uniform() < 0.33) p.to_x += random.uniform(2, 20), p.to_y -= random.uniform(1, 9);
  }
  const FitPerspectiveResult fit = fit_points(pairs);
  EXPECT_TRUE(fit.solved);
  // 800 good points of 0.05 px determine the corners to about 0.02 px.
  EXPECT_LT(apart_px(fit.target_from_reference, known()), 0.06);
}

TEST(FitPerspective, IsThePerspectiveOfWhateverPlaceThePictureHas) {
  const FitPerspectiveResult near = fit_points(pairs_of(known()));
  const FitPerspectiveResult far = fit_points(pairs_of(known(), 10000));
  ASSERT_TRUE(near.solved && far.solved);
  const auto p = map_point(near.target_from_reference, 100, 50);
  const auto q = map_point(far.target_from_reference, 10100, 10050);
  EXPECT_NEAR(p[0], q[0] - 10000, 1e-4);
  EXPECT_NEAR(p[1], q[1] - 10000, 1e-4);
}

TEST(FitPerspective, ReportsPointsOnALineAndFewPointsAsUnsolved) {
  std::vector<PointPair> line;
  for (int i = 0; i < 40; ++i) line.push_back({1.0 * i, 2.0 * i, i + 1.0, 2.0 * i});
  EXPECT_FALSE(fit_points(line).solved);
  EXPECT_FALSE(fit_points({{0, 0, 0, 0}, {1, 0, 1, 0}, {0, 1, 0, 1}}).solved);
  EXPECT_EQ(fit_points({}).target_from_reference.values, (std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}));
}

TEST(FitPerspective, LooksAtTheMaskAlone) {
  FlowField flow{32, 32, std::vector<Vec2f>(1024, Vec2f{9, 9}), std::vector<std::uint8_t>(1024, 1)};
  Image mask{32, 32, 1, std::vector<std::uint8_t>(1024, 0)};
  for (std::size_t p = 0; p < 1024; ++p)
    if (p % 32 < 10) flow.displacement_px[p] = {2, -1}, mask.pixels[p] = 255;
  const FitPerspectiveResult fit = fit_perspective(flow, &mask);
  const auto p = map_point(fit.target_from_reference, 5, 5);
  EXPECT_NEAR(p[0], 7, 1e-6);
  EXPECT_NEAR(p[1], 4, 1e-6);
}

TEST(FitPerspective, RejectsAMaskOfAnotherSize) {
  const FlowField flow{2, 1, {{0, 0}, {0, 0}}, {1, 1}};
  const Image mask{3, 1, 1, {255, 255, 255}};
  EXPECT_THROW_TEXT(fit_perspective(flow, &mask), "mask is 3 x 1 pixels, flow is 2 x 1");
}

}  // namespace
}  // namespace face::mmm
