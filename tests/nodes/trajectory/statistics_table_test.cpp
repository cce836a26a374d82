// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/statistics_table.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::trajectory;

TEST(StatisticsTable, HasARowPerPhoneAndOneOfAllSpeech) {
  const Table table = statistics_table({{{"AA", 3, {0.5, 1}, {4, 1, 1, 9}}}, {"", 12, {0, 2}, {1, 0, 0, 0.25}}});
  EXPECT_EQ(table.columns, (std::vector<std::string>{"frames", "mean_0", "mean_1", "deviation_0", "deviation_1"}));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0].name, "AA");
  EXPECT_EQ(table.rows[0].values, (std::vector<double>{3, 0.5, 1, 2, 3}));
  EXPECT_EQ(table.rows[1].name, "all");
  EXPECT_EQ(table.rows[1].values, (std::vector<double>{12, 0, 2, 1, 0.5}));
}

TEST(StatisticsTable, RejectsAPhoneOfAnotherSize) {
  EXPECT_THROW_TEXT(statistics_table({{{"AA", 3, {0.5}, {4}}}, {"", 12, {0, 2}, {1, 0, 0, 0.25}}}),
                    "phone AA has 1 means and 1 covariances, expected 2 and 4");
}
