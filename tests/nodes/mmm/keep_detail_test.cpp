// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/keep_detail.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/random.h"

namespace face::mmm {
namespace {

constexpr int width = 60, height = 40;

// Fine waves, their crests moved by some pixels.
std::vector<float> waves(double moved_px) {
  std::vector<float> values;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        values.push_back(static_cast<float>(120 + 20 * std::sin(1.2 * (x - moved_px) + 0.4 * y)));
  return values;
}

std::vector<float> mean_of(const std::vector<MixedPicture>& pictures) {
  std::vector<float> mixed(3 * width * height, 0);
  for (const MixedPicture& picture : pictures)
    for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] += static_cast<float>(picture.share) * picture.values[i];
  return mixed;
}

TEST(KeepDetail, BringsAMeanOfPicturesThatLieBesideEachOtherToTheirContrast) {
  const std::vector<MixedPicture> pictures = {{waves(0), 0.5, 0}, {waves(1.2), 0.5, 0}};
  std::vector<float> mixed = mean_of(pictures);
  const double own = detail_energy(pictures[0].values, width, height), before = detail_energy(mixed, width, height);
  // cos^2(0.6 1.2) of it is left.
  EXPECT_NEAR(before / own, std::pow(std::cos(0.72), 2), 0.03);
  keep_detail(mixed, pictures, width, height, 0, 2);
  EXPECT_NEAR(detail_energy(mixed, width, height) / own, 1, 0.1);
}

TEST(KeepDetail, LeavesAMeanOfEqualPicturesAlone) {
  const std::vector<MixedPicture> pictures = {{waves(0), 0.5, 0}, {waves(0), 0.5, 0}};
  std::vector<float> mixed = mean_of(pictures);
  keep_detail(mixed, pictures, width, height, 0, 2);
  EXPECT_EQ(mixed, waves(0));
}

TEST(KeepDetail, DoesNotMakeNoiseStronger) {
  Random random(5);
  std::vector<MixedPicture> pictures(4, {std::vector<float>(3 * width * height), 0.25, 0});
  for (MixedPicture& picture : pictures)
    for (float& value : picture.values) value = static_cast<float>(100 + 4 * random.normal());
  std::vector<float> mixed = mean_of(pictures);
  const double before = detail_energy(mixed, width, height);
  std::vector<float> kept = mixed;
  keep_detail(kept, pictures, width, height, 4, 2);
  // Windows of 9 x 9 have some tenths more or less than the noise's energy by chance.
  EXPECT_LT(detail_energy(kept, width, height) / before, 1.2);
  keep_detail(mixed, pictures, width, height, 0, 2);
  EXPECT_GT(detail_energy(mixed, width, height) / before, 3);
}

TEST(KeepDetail, GivesBackWhatInterpolationTook) {
  std::vector<MixedPicture> pictures = {{waves(0), 0.5, 0}, {waves(0), 0.5, 0}};
  for (MixedPicture& picture : pictures) picture.energy = 1.21 * detail_energy(picture.values, width, height);
  std::vector<float> mixed = mean_of(pictures);
  keep_detail(mixed, pictures, width, height, 0, 2);
  // Two rounds leave a little of the gap.
  EXPECT_NEAR(detail_energy(mixed, width, height) / detail_energy(waves(0), width, height), 1.21, 0.05);
}

}  // namespace
}  // namespace face::mmm
