// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/add_grain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/random.h"
#include "nodes/base/sample_image.h"
#include "nodes/mmm/synthesise.h"
#include "tests/nodes/mmm/mouths.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

Image noisy(double sigma, std::uint64_t seed) {
  Image image = test::painted_mouth(0.3, 1);
  Random random(seed);
  for (auto& value : image.pixels) value = to_byte(value + sigma * random.normal());
  return image;
}
// Four pictures that differ by their noise alone.
Mmm model(double sigma) {
  Mmm made;
  for (std::uint64_t i = 0; i < 4; ++i)
    made.prototypes.push_back({std::to_string(i), noisy(sigma, i), std::vector<std::int16_t>(2 * 96 * 64, 0)});
  return made;
}
const Weights equal{{0, 0, 0, 0, 0.25f, 0.25f, 0.25f, 0.25f}};

TEST(GrainLevel, IsThatOfTheNoise) {
  for (const double sigma : {2.0, 4.0, 8.0}) EXPECT_NEAR(grain_level(noisy(sigma, 3), 1), sigma, 0.15 * sigma + 0.3);
}

TEST(AddGrain, BringsAMeanToTheGrainOfItsPictures) {
  const Mmm four = model(5);
  const Image mean = synthesise(four, equal);
  EXPECT_NEAR(grain_level(mean, 0), 2.5, 0.6);
  EXPECT_NEAR(grain_level(add_grain(four, equal, mean, nullptr), 0), 5, 0.8);
}

TEST(AddGrain, OfAPictureByItselfAddsNone) {
  const Mmm four = model(5);
  const Weights first{{0, 0, 0, 0, 1, 0, 0, 0}};
  const Image one = synthesise(four, first);
  EXPECT_EQ(add_grain(four, first, one, nullptr).pixels, one.pixels);
  EXPECT_EQ(add_grain(four, equal, one, nullptr, {0, 1}).pixels, one.pixels);
}

TEST(AddGrain, DiffersFromFrameToFrameAndIsTheSameTwice) {
  const Mmm four = model(5);
  const Image mean = synthesise(four, equal);
  const std::string a = "17", b = "18";
  EXPECT_EQ(add_grain(four, equal, mean, &a).pixels, add_grain(four, equal, mean, &a).pixels);
  EXPECT_NE(add_grain(four, equal, mean, &a).pixels, add_grain(four, equal, mean, &b).pixels);
  EXPECT_NE(add_grain(four, equal, mean, &a).pixels, add_grain(four, equal, mean, &a, {1, 2}).pixels);
}

TEST(AddGrain, RejectsAnotherCount) {
  const Mmm four = model(5);
  EXPECT_THROW_TEXT(add_grain(four, Weights{{1, 2}}, synthesise(four, equal), nullptr),
                    "there are 2 parameters, expected 8 for 4 prototypes");
}

}  // namespace
}  // namespace face::mmm
