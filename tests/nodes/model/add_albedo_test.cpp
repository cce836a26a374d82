// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/add_albedo.h"

#include <gtest/gtest.h>

#include "nodes/model/check_model.h"
#include "tests/nodes/model/material.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::model;

namespace {

MorphableModel without_albedo() {
  MorphableModel model = test::head_model();
  model.mean_albedo.clear();
  model.albedo = {};
  return model;
}

TEST(AddAlbedo, GivesAModelOfShapesAloneSkin) {
  const MorphableModel model = add_albedo(without_albedo(), {.albedos = 30, .skins = 20});
  check_model(model);
  EXPECT_EQ(model.albedo.size(), 30u);
  const Vec3f nose = model.mean_albedo[model.landmarks68[30]];
  EXPECT_GT(nose[0], nose[2]);  // redder than blue
  EXPECT_EQ(model.identity.modes, test::head_model().identity.modes);
}

TEST(AddAlbedo, DoesSoWithoutLandmarksAndParts) {
  MorphableModel plain = without_albedo();
  plain.landmarks68.clear();
  plain.mean.parts.clear();
  plain.mean.colors_srgb.clear();
  const MorphableModel model = add_albedo(plain, {.albedos = 12});
  check_model(model);
  EXPECT_EQ(model.albedo.size(), 12u);
  EXPECT_TRUE(model.mean.parts.empty());
}

TEST(AddAlbedo, KeepsWhatIsThere) {
  EXPECT_EQ(add_albedo(test::head_model()).albedo.modes, test::head_model().albedo.modes);
  MorphableModel mean = test::head_model();
  mean.albedo = {};
  const MorphableModel model = add_albedo(mean, {.albedos = 6});
  EXPECT_EQ(model.mean_albedo, mean.mean_albedo);
  EXPECT_EQ(model.albedo.size(), 6u);
}

TEST(AddAlbedo, RejectsAModelWithoutPolygons) { EXPECT_THROW_TEXT(add_albedo({}), "the model has no polygons"); }

TEST(AddAlbedo, RejectsAlbedoOfOtherVertices) {
  MorphableModel model = without_albedo();
  model.mean_albedo.resize(3);
  EXPECT_THROW_TEXT(add_albedo(model),
                    "the model has the albedo of 3 vertices, expected " + std::to_string(model.mean.points_mm.size()));
}

}  // namespace
