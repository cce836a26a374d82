// SPDX-License-Identifier: Apache-2.0
// The graphs of graphs/laser_scan, as a person runs them.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/end_to_end/command.h"

namespace {

using test::operator+;
using test::Ended;
using test::Words;
namespace fs = std::filesystem;

class LaserScan : public test::CommandTest {};

TEST_F(LaserScan, AModelIsBuiltFromScansWithoutAHand) {
  const Ended ended = wait(start(Words{"--store", path("store"), "run", graph("laser_scan/build_tiny.json"), "--quiet",
                                       "--out", path("out")}));
  ASSERT_EQ(ended.code, 0) << ended.output;
  for (const char* name : {"mean.png", "scanned.png", "spaces.csv", "expression_errors.csv", "person_errors.csv"})
    EXPECT_TRUE(fs::exists(fs::path(path("out")) / name)) << name;
}

}  // namespace
