// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/lip_rims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/model/pose_model.h"
#include "tests/nodes/model/material.h"

using namespace face;
using namespace face::model;

namespace {

const SkinBasis& skin() {
  static const SkinBasis basis = make_skin_basis(test::head_model(), 0, 4, 0);
  return basis;
}

// The likeliest expression that opens the lips by so much.
std::vector<double> open(double gap_mm) {
  const MorphableModel& model = test::head_model();
  std::vector<double> mean(4, 0.0), expression(4, 0.0);
  double strength = 0;
  const std::vector<std::vector<double>> rows = lip_gap_rows(model);
  for (std::size_t k = 0; k < 4; ++k) {
    for (const std::vector<double>& row : rows) mean[k] += row[k] / static_cast<double>(rows.size());
    strength += std::pow(mean[k] * model.expression.sigmas[k], 2);
  }
  for (std::size_t k = 0; k < 4; ++k)
    expression[k] = gap_mm * mean[k] * std::pow(model.expression.sigmas[k], 2) / strength;
  return expression;
}

float most_parted(const std::vector<double>& first, const std::vector<double>& now) {
  const LipRims rims = PartingLips(test::head_model(), skin(), first).at(now);
  return *std::max_element(rims.parted.begin(), rims.parted.end());
}

TEST(LipRims, PartAsFarAsLipsOpenSinceTheFirstPicture) {
  EXPECT_EQ(most_parted(open(0), open(0)), 0);
  EXPECT_EQ(most_parted(open(1), open(1)), 0);
  EXPECT_GT(most_parted(open(0), open(1)), 0);
  EXPECT_LT(most_parted(open(0), open(1)), 1);
  EXPECT_EQ(most_parted(open(0), open(6)), 1);
}

TEST(LipRims, OfMouthsThatAreOpenInTheFirstPictureAreSeenAsTheyAre) { EXPECT_EQ(most_parted(open(8), open(16)), 0); }

TEST(LipRims, LookUpTheUpperLipAndDownTheLowerOne) {
  const MorphableModel& model = test::head_model();
  const LipRims rims = PartingLips(model, skin(), open(0)).at(open(6));
  const auto outwards = [&](std::uint32_t vertex) {
    const auto found = std::find(skin().vertices.begin(), skin().vertices.end(), vertex);
    return rims.outwards_mm[static_cast<std::size_t>(found - skin().vertices.begin())];
  };
  EXPECT_GT(outwards(model.landmarks68[62]), 3);
  EXPECT_LT(outwards(model.landmarks68[66]), -3);
  for (const std::size_t far : {8u, 30u, 33u, 36u}) EXPECT_EQ(outwards(model.landmarks68[far]), 0) << far;
}

TEST(LipRims, DoNotPartAtTheCornersOfTheMouth) {
  const MorphableModel& model = test::head_model();
  const LipRims rims = PartingLips(model, skin(), open(0)).at(open(6));
  for (std::size_t v = 0; v < skin().vertices.size(); ++v) {
    const float x = model.mean.points_mm[skin().vertices[v]][0];
    if (std::abs(x) >= std::abs(model.mean.points_mm[model.landmarks68[60]][0])) {
      EXPECT_EQ(rims.parted[v], 0);
    }
  }
}

TEST(LipRims, AreNoneWhereTheModelNamesNoLandmarks) {
  MorphableModel model = test::head_model();
  model.landmarks68.clear();
  EXPECT_TRUE(PartingLips(model, skin(), open(0)).at(open(6)).parted.empty());
}

}  // namespace
