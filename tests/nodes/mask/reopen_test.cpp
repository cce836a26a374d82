// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/reopen.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::mask;

DepthScan flat_scan() {
  DepthScan scan;
  scan.picture = {4, 3, 1, std::vector<std::uint8_t>(12, 90)};
  scan.depth_mm.assign(12, 800.0f);
  return scan;
}

TEST(Reopen, TakesDepthOutWhereTheInteriorIsWhiteAndNowhereElse) {
  Image interior{4, 3, 1, std::vector<std::uint8_t>(12, 0)};
  interior.pixels[5] = interior.pixels[6] = 255;
  const DepthScan opened = reopen(flat_scan(), interior);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(opened.depth_mm[i], i == 5 || i == 6 ? 0.0f : 800.0f) << i;
  EXPECT_EQ(opened.picture.pixels, flat_scan().picture.pixels);
}

TEST(Reopen, LeavesAScanAsItIsWhereNothingIsInside) {
  EXPECT_EQ(reopen(flat_scan(), Image{4, 3, 1, std::vector<std::uint8_t>(12, 0)}).depth_mm, flat_scan().depth_mm);
}

TEST(Reopen, RejectsAnInteriorOfAnotherSize) {
  EXPECT_THROW_TEXT(reopen(flat_scan(), Image{2, 3, 1, std::vector<std::uint8_t>(6, 0)}),
                    "interior has 6 pixels, the scan 12");
}

}  // namespace
