// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/merge.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::texture;

namespace {

AlbedoMap map_of(float colour, std::vector<float> weights) {
  AlbedoMap map;
  map.width = static_cast<int>(weights.size());
  map.height = 1;
  map.albedo.assign(weights.size(), Vec3f{colour, colour, colour});
  map.weight = std::move(weights);
  return map;
}

TEST(Merge, TakesEachTexelFromThePictureThatShowsIt) {
  const AlbedoMap merged =
      merge(engine::Seq<AlbedoMap>({map_of(0.2f, {1, 0, 0.5f, 0}), map_of(0.6f, {0, 1, 0.5f, 0})}));
  EXPECT_NEAR(merged.albedo[0][0], 0.2f, 1e-3f);
  EXPECT_NEAR(merged.albedo[1][0], 0.6f, 1e-3f);
  EXPECT_NEAR(merged.albedo[2][0], 0.4f, 1e-5f);
  EXPECT_NEAR(merged.albedo[3][0], 0.4f, 1e-5f);  // nobody shows it
  EXPECT_EQ(merged.weight[3], 0.0f);
}

TEST(Merge, OfOneMapIsThatMap) {
  EXPECT_NEAR(merge(engine::Seq<AlbedoMap>({map_of(0.3f, {1, 0})})).albedo[1][2], 0.3f, 1e-6f);
}

TEST(Merge, RejectsMapsOfDifferentSizes) {
  EXPECT_THROW_TEXT(merge(engine::Seq<AlbedoMap>({map_of(0.2f, {1}), map_of(0.2f, {1, 1})})),
                    "a map is 2 x 1 texels, the first 1 x 1");
}

}  // namespace
