// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/match_labels.h"

#include <gtest/gtest.h>

#include "tests/nodes/flow/moving_picture.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::flow;

MatchLabelsOptions options_for_grey() {
  MatchLabelsOptions options;
  options.weights = {1};
  options.caps = {60};
  options.step_cost = 5;
  options.jump_cost = 60;
  return options;
}

}  // namespace

TEST(MatchLabels, FindsTwoShiftsWithASharpEdge) {
  const Level still = level_of(test::still(64, 64));
  Level moved = still;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      moved.channels[0].row(y)[x] = static_cast<float>(y < 32 ? test::pattern(x - 3, y + 9) : test::pattern(x, y - 2));
  Plane u(64, 64), v(64, 64);
  match_labels(moved, still, {8, 16, 55, 47}, options_for_grey(), u, v);
  for (int y = 16; y <= 47; ++y)
    for (int x = 8; x <= 55; ++x) {
      EXPECT_EQ(u.row(y)[x], y < 32 ? -3 : 0) << x << " " << y;
      EXPECT_EQ(v.row(y)[x], y < 32 ? 9 : -2) << x << " " << y;
    }
  EXPECT_EQ(v.row(15)[20], 0);  // outside the box
}

TEST(MatchLabels, LooksAboutTheFieldGiven) {
  const Level still = level_of(test::still(64, 64));
  Level moved = still;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) moved.channels[0].row(y)[x] = static_cast<float>(test::pattern(x - 11, y + 2));
  Plane u(64, 64, -10), v(64, 64);
  match_labels(moved, still, {20, 20, 40, 40}, options_for_grey(), u, v);
  EXPECT_EQ(u.row(30)[30], -11);
  EXPECT_EQ(v.row(30)[30], 2);
}

TEST(MatchLabels, CostsHalfOfWhatCountsWhereNothingIsMeasured) {
  Level still = level_of(test::still(64, 64));
  const MatchLabelsOptions options = options_for_grey();
  EXPECT_EQ(match_cost(still, still, options, 10, 10, 10, 10), 0);
  EXPECT_EQ(match_cost(still, still, options, 10, 10, -1, 10), 30);
  EXPECT_EQ(match_cost(still, still, options, 10, 10, 10, 64), 30);
  still.share.row(10)[10] = 0;
  EXPECT_EQ(match_cost(still, still, options, 10, 10, 10, 10), 30);
}

TEST(MatchLabels, RejectsAReachItHasNoRoomFor) {
  const Level still = level_of(test::still(64, 64));
  MatchLabelsOptions options = options_for_grey();
  options.reach_y_px = 15;
  Plane u(64, 64), v(64, 64);
  EXPECT_THROW_TEXT(match_labels(still, still, {0, 0, 9, 9}, options, u, v),
                    "reach is 4 x 15 px, expected at most 14 px vertically");
}
