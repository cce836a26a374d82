// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/refine_perspective.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/random.h"
#include "nodes/base/sample_image.h"
#include "nodes/mmm/fit_perspective.h"
#include "nodes/mmm/warp_perspective.h"

namespace face::mmm {
namespace {

Image textured() {
  Image image{120, 90, 3, {}};
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x)
      for (int c = 0; c < 3; ++c)
        image.pixels.push_back(to_byte(128 + 40 * std::sin(0.31 * x + 0.1 * y) * std::cos(0.27 * y - 0.05 * x) +
                                       30 * std::sin(0.09 * x - 0.11 * y)));
  return image;
}

const Matrix motion{3, 3, {1.006, 0.009, 1.7, -0.008, 1.003, -1.2, 3e-5, 2e-5, 1}};

double worst_px(const Matrix& found, const Matrix& truth) {
  double worst = 0;
  for (const auto& [x, y] : {std::pair{15.0, 15.0}, {100.0, 20.0}, {60.0, 45.0}, {20.0, 75.0}, {105.0, 70.0}}) {
    const auto a = map_point(found, x, y), b = map_point(truth, x, y);
    worst = std::max(worst, std::hypot(a[0] - b[0], a[1] - b[1]));
  }
  return worst;
}

const Matrix identity{3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}};

TEST(RefinePerspective, ComesFromAPixelOffToAFewHundredths) {
  const Image reference = textured(), frame = warp_perspective(reference, motion, {.inverse = true});
  EXPECT_GT(worst_px(identity, motion), 1.5);
  // Interpolation that made the frame and rounding to bytes leave so much.
  EXPECT_LT(worst_px(refine_perspective(reference, frame, nullptr, identity), motion), 0.04);
}

TEST(RefinePerspective, IsNotPulledByWhatMovesOtherwiseNorByNoise) {
  const Image reference = textured();
  Image frame = warp_perspective(reference, motion, {.inverse = true});
  const Image other = warp_perspective(reference, Matrix{3, 3, {1, 0, -3, 0, 1, 3, 0, 0, 1}});
  for (int y = 30; y < 62; ++y)
    for (int x = 40 * 3; x < 75 * 3; ++x) {
      const auto at = static_cast<std::size_t>(y * 360 + x);
      frame.pixels[at] = other.pixels[at];
    }
  Random random(3);
  for (auto& value : frame.pixels) value = to_byte(value + 2 * random.normal());
  EXPECT_LT(worst_px(refine_perspective(reference, frame, nullptr, identity), motion), 0.12);
}

TEST(RefinePerspective, LooksAtTheMaskAlone) {
  const Image reference = textured();
  Image frame = warp_perspective(reference, motion, {.inverse = true}), mask{120, 90, 1, {}};
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) {
      mask.pixels.push_back(x < 70 ? 255 : 0);
      // More than half of the picture beside it is another one.
      if (x >= 74) frame.pixels[static_cast<std::size_t>(3 * (y * 120 + x))] = 10;
    }
  const Matrix found = refine_perspective(reference, frame, &mask, identity);
  const auto a = map_point(found, 30, 40), b = map_point(motion, 30, 40);
  EXPECT_LT(std::hypot(a[0] - b[0], a[1] - b[1]), 0.04);
}

TEST(RefinePerspective, StaysWhereThePicturesTellNothing) {
  const Image flat{40, 30, 3, std::vector<std::uint8_t>(40 * 30 * 3, 90)};
  Image striped = flat;  // tells x alone
  for (std::size_t i = 0; i < striped.pixels.size(); ++i)
    striped.pixels[i] = to_byte(100 + 50 * std::sin(0.3 * static_cast<double>(i / 3 % 40)));
  EXPECT_EQ(refine_perspective(flat, flat, nullptr, motion).values, motion.values);
  EXPECT_EQ(refine_perspective(striped, striped, nullptr, motion).values, motion.values);
  const Image none{120, 90, 1, std::vector<std::uint8_t>(120 * 90, 0)};
  EXPECT_EQ(refine_perspective(textured(), textured(), &none, motion).values, motion.values);
}

}  // namespace
}  // namespace face::mmm
