// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/stabilise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::track;

Landmarks rest() {
  return {{{"eye_inner_r", 140, 100}, {"eye_inner_l", 180, 101}, {"nose_tip", 160, 140}, {"lip_0", 140, 170}}};
}

Landmarks turned(Landmarks points, double angle, double scale, double dx, double dy) {
  for (Landmark& point : points.points) {
    const double x = point.x_px, y = point.y_px;
    point.x_px = scale * (std::cos(angle) * x - std::sin(angle) * y) + dx;
    point.y_px = scale * (std::sin(angle) * x + std::cos(angle) * y) + dy;
  }
  return points;
}

engine::Window<Landmarks> window(const std::vector<Landmarks>& frames, std::size_t centre) {
  std::vector<std::shared_ptr<const Landmarks>> held;
  for (const Landmarks& frame : frames) held.push_back(std::make_shared<const Landmarks>(frame));
  return {held, centre};
}

}  // namespace

TEST(Stabilise, TakesAMovedTurnedScaledHeadBack) {
  Landmarks open = rest();
  open.points[3].y_px = 177;
  const Landmarks moved = turned(open, 0.2, 1.1, 14, -9);
  const Landmarks stable = stabilise(window({moved, moved}, 1), rest());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(stable.points[i].x_px, open.points[i].x_px, 1e-9);
    EXPECT_NEAR(stable.points[i].y_px, open.points[i].y_px, 1e-9);
  }
}

TEST(Stabilise, TremblesLessWithNeighbours) {
  Landmarks shaken = rest();
  shaken.points[0].y_px += 1;
  const StabiliseOptions alone{.smooth_frames = 0};
  const auto off = [&](const StabiliseOptions& options) {
    const Landmark lip = stabilise(window({rest(), shaken, rest()}, 1), rest(), options).points[3];
    return std::hypot(lip.x_px - 140, lip.y_px - 170);
  };
  const double plain = off(alone), smooth = off({});
  EXPECT_GT(plain, 0.3);
  EXPECT_LT(smooth, 0.6 * plain);
}

TEST(Stabilise, KeepsTheScaleWhereOnePointIsSeen) {
  Landmarks moved = turned(rest(), 0, 1, 5, 6);
  moved.points[0].valid = moved.points[1].valid = false;
  const Landmarks stable = stabilise(window({moved}, 0), rest());
  EXPECT_NEAR(stable.points[3].x_px, 140, 1e-9);
  EXPECT_NEAR(stable.points[3].y_px, 170, 1e-9);
  EXPECT_TRUE(stable.points[3].valid);
}

TEST(Stabilise, SaysThatNothingIsKnownWithoutARigidPoint) {
  Landmarks lost = rest();
  for (std::size_t i = 0; i < 3; ++i) lost.points[i].valid = false;
  const Landmarks stable = stabilise(window({rest(), lost}, 1), rest());
  for (const Landmark& point : stable.points) EXPECT_FALSE(point.valid);
  EXPECT_EQ(stable.points[3].y_px, 170);
}

TEST(Stabilise, NamesARigidPointThatRestDoesNotHave) {
  EXPECT_THROW_TEXT(stabilise(window({rest()}, 0), {{{"lip_0", 1, 2}}}),
                    "rest has no point eye_inner_r, expected all rigid ones");
}
