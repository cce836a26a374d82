// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::decode;

namespace {

Table table(const std::string& text, const std::string& suffix = ".csv") {
  return read_table(engine::File::from_bytes(text, suffix));
}

}  // namespace

TEST(ReadTable, TakesTextColumnsForNames) {
  const Table read = table(
      "\xEF\xBB\xBF"
      "frame,point,x_px,kind\r\n3,lip left,1.5,inner\r\n4,\"a,\"\"b\"\"\",,outer\r\n");
  EXPECT_EQ(read.columns, (std::vector<std::string>{"frame", "x_px"}));
  ASSERT_EQ(read.rows.size(), 2u);
  EXPECT_EQ(read.rows[0].name, "lip left inner");
  EXPECT_EQ(read.rows[1].name, "a,\"b\" outer");
  EXPECT_EQ(read.rows[0].values, (std::vector<double>{3, 1.5}));
  EXPECT_TRUE(std::isnan(read.rows[1].values[1]));
}

TEST(ReadTable, NumbersRowsWithoutNames) {
  const Table read = table("a,b\n1,2\n\n3,inf");
  ASSERT_EQ(read.rows.size(), 2u);
  EXPECT_EQ(read.rows[1].name, "1");
  EXPECT_TRUE(std::isinf(read.rows[1].values[1]));
}

TEST(ReadTable, TakesOurOwnNamesEvenWhereTheyAreNumbers) {
  EXPECT_EQ(table("name,a\n17,2\n").rows[0].name, "17");
  EXPECT_TRUE(table("name,a\n").rows.empty());
}

TEST(ReadTable, SaysWhereAFileIsWrong) {
  EXPECT_THROW_TEXT(table(""), "the data: is empty, expected a head line");
  EXPECT_THROW_TEXT(table("a,b\n1,2\n3\n"), "the data:3: found 1 cells, expected 2, as the head line has");
  EXPECT_THROW_TEXT(table("a,\n1,2\n"), "the data:1: column 2 has no name");
  EXPECT_THROW_TEXT(table("a\n\"1\n"), "the data:2: found a quote that is not closed");
  EXPECT_THROW_TEXT(table("a\n1\n", ".xlsx"),
                    "the data: found the suffix \".xlsx\", expected .csv: comma-separated values with a head line");
}
