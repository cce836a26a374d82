// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/edit_distance.h"

#include <gtest/gtest.h>

namespace face {
namespace {

TEST(EditDistance, CountsLettersToPutInTakeOutOrChange) {
  EXPECT_EQ(edit_distance("depth_unit", "depth_unit"), 0u);
  EXPECT_EQ(edit_distance("rate_hz", "rate_h"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(EditDistance, IsTheSameFromEitherSide) {
  EXPECT_EQ(edit_distance("jawOpen", "jawPen"), edit_distance("jawPen", "jawOpen"));
}

TEST(EditDistance, OfNothingIsTheOthersLength) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
}

}  // namespace
}  // namespace face
