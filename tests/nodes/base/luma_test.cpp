// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/luma.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace {

TEST(Luma, OfAGreyPixelIsExactlyItsValue) {
  for (int value = 0; value < 256; ++value) {
    const auto byte = static_cast<std::uint8_t>(value);
    const std::uint8_t pixel[3] = {byte, byte, byte};
    EXPECT_EQ(face::grey_value<float>(pixel, 3), static_cast<float>(value));
    EXPECT_EQ(face::grey_value<float>(pixel, 1), static_cast<float>(value));
  }
}

TEST(Luma, OfPureRedGreenAndBlueIsTheirWeight) {
  EXPECT_NEAR(face::luma(255.0, 0.0, 0.0), 0.299 * 255, 1e-12);
  EXPECT_NEAR(face::luma(0.0, 255.0, 0.0), 0.587 * 255, 1e-12);
  EXPECT_NEAR(face::luma(0.0, 0.0, 255.0), 0.114 * 255, 1e-12);
}

TEST(Luma, LeavesAlphaOut) {
  const std::uint8_t clear[4] = {40, 90, 200, 0}, solid[4] = {40, 90, 200, 255};
  EXPECT_EQ(face::grey_value<double>(clear, 4), face::grey_value<double>(solid, 4));
}

}  // namespace
