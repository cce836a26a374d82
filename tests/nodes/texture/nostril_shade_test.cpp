// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/nostril_shade.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/decode/read_rig.h"
#include "tests/nodes/model/material.h"
#include "tests/support/data.h"
#include "tests/support/folder_file.h"

using namespace face;
using namespace face::texture;

namespace {

// Nostrils that a smile's picture does not show shone in the other mouths' pictures.
TEST(NostrilShade, IsDarkInNostrilsAlone) {
  DATA_FILE(folder, "ict-face/FaceXModel");
  const Rig head = decode::read_rig(test::folder_file(folder), nullptr);
  MorphableModel model;
  model.mean = head.neutral;
  model.landmarks68 = head.landmarks68;
  const std::vector<float> shade = nostril_shade(model);
  EXPECT_GT(std::count_if(shade.begin(), shade.end(), [](float s) { return s < 0.2f; }), 40);
  for (std::size_t i = 0; i < shade.size(); ++i) {
    const Vec3f& p = model.mean.points_mm[i];
    const Vec3f& base = model.mean.points_mm[model.landmarks68[33]];
    if (std::abs(p[0] - base[0]) > 25 || p[1] > base[1] + 30 || p[1] < base[1] - 22) {
      EXPECT_EQ(shade[i], 1.0f) << i;
    }
  }
  for (const std::size_t mark : {27u, 28u, 29u, 30u, 50u, 51u, 52u}) EXPECT_GT(shade[head.landmarks68[mark]], 0.9f);
}

TEST(NostrilShade, IsNoneWithoutLandmarks) {
  MorphableModel model = test::head_model();
  model.landmarks68.clear();
  EXPECT_EQ(nostril_shade(model), std::vector<float>(model.mean.points_mm.size(), 1.0f));
}

}  // namespace
