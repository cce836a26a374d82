// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "nodes/model/sample_scan.h"

namespace {

using namespace face;
using namespace face::model;

TEST(RegionWeights, AreOneInsideFallTowardsTheBorderAndEndThere) {
  const RegionWeightsOptions options;
  Mesh mesh;
  // uvs have their origin at the bottom left, the options at the top.
  const auto add = [&](double share_of_half_width) {
    mesh.points_mm.push_back({0, 0, 0});
    mesh.uvs.push_back({static_cast<float>(options.centre_x + share_of_half_width * options.width / 2),
                        static_cast<float>(1 - options.centre_y)});
  };
  for (const double share : {0.0, 0.5, 0.8, 0.95, 1.1}) add(share);
  const Matrix weights = region_weights(mesh, options);
  ASSERT_EQ(weights.rows, 5u);
  ASSERT_EQ(weights.columns, 1u);
  EXPECT_EQ(weights.values[0], 1);
  EXPECT_EQ(weights.values[1], 1);
  EXPECT_LT(weights.values[2], 1);
  EXPECT_LT(weights.values[3], weights.values[2]);
  EXPECT_GT(weights.values[3], 0);
  EXPECT_EQ(weights.values[4], 0);
}

}  // namespace
