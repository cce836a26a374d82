// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/quantile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace face {
namespace {

TEST(Median, IsOneOfTheValuesTheUpperOfTwoInTheMiddle) {
  EXPECT_EQ(median(std::vector<double>{9, 1, 5}), 5);
  EXPECT_EQ(median(std::vector<float>{4, 1, 3, 2}), 3);
  EXPECT_EQ(median(std::vector<double>{7}), 7);
}

TEST(Median, OfNothingIsZero) { EXPECT_EQ(median(std::vector<double>{}), 0); }

TEST(Quantile, LiesBetweenNeighboursInRankAsThatOfNumpy) {
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.95), 3.85);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0), 1);
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 1), 4);
  EXPECT_DOUBLE_EQ(quantile({7}, 0.95), 7);
}

TEST(Quantile, OfNothingIsNoNumber) { EXPECT_TRUE(std::isnan(quantile({}, 0.5))); }

}  // namespace
}  // namespace face
