// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/scan_channels.h"

#include <gtest/gtest.h>

namespace {

using namespace face;

TEST(CylinderChannels, AreRadiusAndGreyAndKnowWhatWasNotMeasured) {
  CylinderScan scan;
  scan.picture = {2, 2, 3, {255, 255, 255, 0, 0, 0, 255, 0, 0, 9, 9, 9}};
  scan.radius_mm = {80, 0, 90, 100};
  const FeatureMap map = flow::cylinder_channels(scan);
  EXPECT_EQ(map.names, (std::vector<std::string>{"radius", "grey"}));
  EXPECT_EQ(map.valid, (std::vector<std::uint8_t>{1, 0, 1, 1}));
  ASSERT_EQ(map.values.size(), 8u);
  EXPECT_EQ(map.values[2], 90);
  EXPECT_EQ(map.values[4], 255);  // exactly, as of a grey picture
  EXPECT_EQ(map.values[7], 9);
  EXPECT_NEAR(map.values[6], 0.299 * 255, 0.5);  // BT.601 luma of red
}

}  // namespace
