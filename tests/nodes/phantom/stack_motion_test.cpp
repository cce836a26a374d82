// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/stack_motion.h"

#include <gtest/gtest.h>

#include <vector>

namespace face::phantom {
namespace {

TEST(StackMotion, HasARowOfTwelveForEveryFrame) {
  RigidMotion second;
  second.rotation = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  second.translation_mm = {4, 5, 6};
  const Matrix stacked = stack_motion(engine::Seq<RigidMotion>(std::vector<RigidMotion>{{}, second}));
  EXPECT_EQ(stacked.rows, 2u);
  EXPECT_EQ(stacked.columns, 12u);
  EXPECT_EQ(stacked.values, (std::vector<double>{1, 0,  0, 0, 1, 0, 0, 0, 1, 0, 0, 0,  //
                                                 0, -1, 0, 1, 0, 0, 0, 0, 1, 4, 5, 6}));
}

TEST(StackMotion, OfNothingHasNoRow) { EXPECT_EQ(stack_motion({}).rows, 0u); }

}  // namespace
}  // namespace face::phantom
