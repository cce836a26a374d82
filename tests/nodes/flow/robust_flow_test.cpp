// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/robust_flow.h"

#include <gtest/gtest.h>

#include "nodes/flow/despike.h"
#include "nodes/flow/image_channels.h"
#include "nodes/flow/opencv_flow.h"
#include "tests/nodes/flow/moving_picture.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/scan_frames.h"

namespace {

using namespace face;
using namespace face::flow;

double face_error_px(const FlowField& truth, const FlowField& flow) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < truth.valid.size(); ++i) {
    if (!truth.valid[i]) continue;
    sum += std::hypot(static_cast<double>(flow.displacement_px[i][0] - truth.displacement_px[i][0]),
                      static_cast<double>(flow.displacement_px[i][1] - truth.displacement_px[i][1]));
    ++count;
  }
  return sum / count;
}

// 20 % of the pixels take any value.
void spoil_pixels(Image& image, std::uint64_t seed) {
  Random random(seed);
  for (auto& p : image.pixels)
    if (random.uniform() < 0.2) p = static_cast<std::uint8_t>(random.uniform(0, 256));
}

// 20 % of the area is covered by speckled squares.
void spoil_patches(Image& image) {
  Random random(5);
  int covered = 0;
  while (covered < image.width * image.height / 5) {
    const int x = static_cast<int>(random.uniform(0, image.width - 24)),
              y = static_cast<int>(random.uniform(0, image.height - 24));
    const int side = static_cast<int>(random.uniform(8, 24));
    const double grey = random.uniform(10, 245);
    for (int j = y; j < y + side; ++j)
      for (int i = x; i < x + side; ++i, ++covered)
        image.pixels[static_cast<std::size_t>(j * image.width + i)] =
            static_cast<std::uint8_t>(grey + random.uniform(-10, 10));
  }
}

class RobustFlowOnAFace : public ::testing::Test {
 protected:
  RobustFlowOnAFace() {
    test::ScanLook look;
    look.width = 320;
    look.height = 240;
    look.noise_grey = 1;
    look.dot_radius_mm = -5;
    const test::ScanScene scene(look);
    RigidMotion motion;
    motion.rotation = {std::cos(0.03), -std::sin(0.03), 0, std::sin(0.03), std::cos(0.03), 0, 0, 0, 1};
    motion.translation_mm = {2.5, 1.5, 0};
    const auto a = scene.frame(scene.points({}), 1), b = scene.frame(scene.points({{"jawOpen", 0.3f}}, motion), 2);
    reference = a.scan.picture;
    target = b.scan.picture;
    truth = scene.truth(a, b);
  }
  void expect_better_than_dis_and_farneback() const {
    const FeatureMap a = image_channels(reference, nullptr), b = image_channels(target, nullptr);
    const double error = face_error_px(truth, robust_flow(a, b, nullptr));
    EXPECT_LT(error, 0.8 * face_error_px(truth, dis_flow(a, b, nullptr)));
    EXPECT_LT(error, 0.8 * face_error_px(truth, farneback_flow(a, b, nullptr)));
  }
  Image reference, target;
  FlowField truth;
};

}  // namespace

TEST(RobustFlow, FindsAKnownTranslationToATenthOfAPixel) {
  for (const auto& [u, v] : {std::pair{0.3f, -0.6f}, std::pair{3.2f, 1.7f}}) {
    const test::Motion motion = [u = u, v = v](double, double) { return Vec2f{u, v}; };
    const FlowField flow = robust_flow(test::still(), test::picture(160, 120, motion), nullptr);
    EXPECT_LE(test::mean_error_px(flow, motion), 0.1) << u;
  }
}

TEST(RobustFlow, KeepsTheEdgeBetweenTwoMotions) {
  const test::Motion left =
                         [](double, double) {
                           return Vec2f{2, 0};
                         },
                     right = [](double, double) {
                       return Vec2f{-2, 0};
                     };
  const FeatureMap a = test::still();
  const FeatureMap l = test::picture(160, 120, left), r = test::picture(160, 120, right);
  FeatureMap b = l;
  for (int y = 0; y < 120; ++y)
    for (int x = 80; x < 160; ++x)
      b.values[static_cast<std::size_t>(y * 160 + x)] = r.values[static_cast<std::size_t>(y * 160 + x)];
  const FlowField flow = robust_flow(a, b, nullptr);
  for (int y = 20; y < 100; ++y) {
    EXPECT_NEAR(flow.displacement_px[static_cast<std::size_t>(y * 160 + 68)][0], 2, 0.5) << y;
    EXPECT_NEAR(flow.displacement_px[static_cast<std::size_t>(y * 160 + 92)][0], -2, 0.5) << y;
  }
}

TEST_F(RobustFlowOnAFace, BeatsDisAndFarnebackWhenAFifthOfThePixelsIsWild) {
  spoil_pixels(target, 5);
  expect_better_than_dis_and_farneback();
}

TEST_F(RobustFlowOnAFace, BeatsDisAndFarnebackWhenAFifthOfBothPicturesIsWild) {
  spoil_pixels(reference, 5);
  spoil_pixels(target, 6);
  expect_better_than_dis_and_farneback();
}

TEST_F(RobustFlowOnAFace, BeatsDisAndFarnebackWhenAFifthOfTheTargetIsCovered) {
  spoil_patches(target);
  expect_better_than_dis_and_farneback();
}

TEST(RobustFlow, LeavesMaskedPixelsOut) {
  const test::Motion motion = [](double, double) { return Vec2f{1.5f, 1}; };
  FeatureMap a = test::still(), b = test::picture(160, 120, motion);
  for (int y = 40; y < 80; ++y)
    for (int x = 60; x < 100; ++x) {
      const auto i = static_cast<std::size_t>(y * 160 + x);
      a.valid[i] = 0;
      a.values[i] = 255;
    }
  const FlowField flow = robust_flow(a, b, nullptr);
  EXPECT_EQ(flow.valid[60 * 160 + 80], 0);
  EXPECT_LE(test::mean_error_px(flow, motion), 0.1);
}

TEST(RobustFlow, RejectsPicturesOfUnequalSize) {
  EXPECT_THROW_TEXT(robust_flow(test::still(), test::still(160, 110), nullptr),
                    "target is 160 x 110 pixels, reference 160 x 120");
}

TEST(Despike, ReplacesAWildPixelAndLeavesASmallDot) {
  Plane plane(20, 20);
  for (std::size_t i = 0; i < plane.values.size(); ++i) plane.values[i] = 100 + static_cast<float>(i % 3);
  plane.row(5)[5] = 250;
  for (int y = 10; y < 13; ++y)
    for (int x = 10; x < 13; ++x) plane.row(y)[x] = 220;
  despike(plane, 24);
  EXPECT_NEAR(plane.row(5)[5], 101, 1);
  EXPECT_EQ(plane.row(11)[11], 220);
  EXPECT_EQ(plane.row(10)[11], 220);
}
