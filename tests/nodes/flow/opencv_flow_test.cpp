// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/opencv_flow.h"

#include <gtest/gtest.h>

#include "tests/nodes/flow/moving_picture.h"
#include "tests/support/expect_throw_text.h"

namespace {
using namespace face;
using namespace face::flow;

const test::Motion motion = [](double, double) { return Vec2f{2.25f, -1.5f}; };
}  // namespace

TEST(OpencvFlow, EachFindsAKnownTranslation) {
  const FeatureMap a = test::still(), b = test::picture(160, 120, motion);
  EXPECT_LE(test::mean_error_px(dis_flow(a, b, nullptr), motion), 0.1);
  EXPECT_LE(test::mean_error_px(farneback_flow(a, b, nullptr), motion), 0.2);
  EXPECT_LE(test::mean_error_px(tvl1_flow(a, b, nullptr), motion), 0.1);
}

TEST(OpencvFlow, EachTakesAStart) {
  const test::Motion far = [](double, double) { return Vec2f{36, 1}; };
  const FeatureMap a = test::still(), b = test::picture(160, 120, far);
  const FlowField start{160, 120, std::vector<Vec2f>(160 * 120, {35, 0}), std::vector<std::uint8_t>(160 * 120, 1)};
  EXPECT_LE(test::mean_error_px(dis_flow(a, b, &start), far), 0.3);
  EXPECT_LE(test::mean_error_px(farneback_flow(a, b, &start), far), 0.3);
  EXPECT_LE(test::mean_error_px(tvl1_flow(a, b, &start), far), 0.3);
}

TEST(OpencvFlow, EachTakesTheRadius) {
  FeatureMap a = test::still(), b = test::picture(160, 120, motion);
  for (FeatureMap* map : {&a, &b}) {
    map->names = {"radius"};
    for (float& x : map->values) x = 80 + x / 25;
  }
  EXPECT_LE(test::mean_error_px(dis_flow(a, b, nullptr, {"radius"}), motion), 0.1);
}

TEST(OpencvFlow, NamesTheChannelsThatThereAre) {
  EXPECT_THROW_TEXT(dis_flow(test::still(), test::still(), nullptr, {"radius"}),
                    "channel is \"radius\", the pictures have grey");
}
