// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/check_model.h"

#include <gtest/gtest.h>

#include "tests/nodes/model/material.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::model;

namespace {

MorphableModel triangle() {
  MorphableModel model;
  model.mean.points_mm.assign(3, {0, 0, 0});
  model.mean.corners = {0, 1, 2};
  model.mean.polygon_starts = {0, 3};
  model.mean_albedo.assign(3, {0.5f, 0.5f, 0.5f});
  return model;
}

TEST(CheckModel, AcceptsModelsThatFit) {
  EXPECT_NO_THROW(check_model(triangle()));
  EXPECT_NO_THROW(check_model(test::head_model()));
}

TEST(CheckModel, NamesWhatDoesNotFit) {
  MorphableModel model = triangle();
  model.inner_lips = {{2, 7}};
  EXPECT_THROW_TEXT(check_model(model), "the model's lips meet at vertices 2 and 7, expected ones below 3");
  model = triangle();
  model.expression = {{"smile"}, {1}, {{1, 0, 0}, {1, 0, 0}}};
  EXPECT_THROW_TEXT(check_model(model), "the model's 1 expression components have 2 offsets, expected 3 each");
  model = triangle();
  model.mean_albedo.pop_back();
  EXPECT_THROW_TEXT(check_model(model), "the model has the albedo of 2 vertices, expected 3");
  model = triangle();
  model.landmarks68 = {1, 3};
  EXPECT_THROW_TEXT(check_model(model), "a landmark of the model is vertex 3, expected one below 3");
  model = triangle();
  model.mean.corners[1] = 4;
  EXPECT_THROW_TEXT(check_model(model), "a polygon has vertex 4, but the mesh has 3");
  model = triangle();
  model.mean.parts = {{"face", 0, 2}};
  EXPECT_THROW_TEXT(check_model(model), "part \"face\" ends at polygon 2 of 1");
}

}  // namespace
