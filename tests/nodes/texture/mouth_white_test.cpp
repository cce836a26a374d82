// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/mouth_white.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/model/light_model.h"
#include "nodes/model/skin_atlas.h"
#include "tests/nodes/texture/drawn_face.h"

using namespace face;
using namespace face::texture;
using namespace test;

namespace {

// Hair, neck and eyes are no skin that teeth could be compared with: teeth came out grey.
TEST(MouthWhite, IsALittleBrighterThanTheSkinAboutTheMouthWhateverIsElsewhere) {
  const FaceFit fit = true_fit(0);
  const Rig& person = test::head();
  const PosedFace face = pose_face(person.neutral, person.neutral.points_mm, fit, 1);
  const model::SkinAtlas atlas = model::make_skin_atlas(person.neutral);
  AlbedoMap map = striped_map();
  std::fill(map.albedo.begin(), map.albedo.end(), Vec3f{0.4f, 0.3f, 0.2f});
  const MouthWhite plain = mouth_white(person, map, atlas, face, fit.light);
  const double skin = model::shown(fit.light, {model::light_at(fit.light, 0, 0.8) * 0.4, 0, 0})[0];
  EXPECT_NEAR(plain.colour[0], skin, 0.15 * skin);
  EXPECT_LT(plain.colour[0] / plain.colour[2], 1.3);  // paler than the skin, whose channels differ by 1.5 there
  EXPECT_GT(plain.parallel, 0.3);
  const float eyes = person.neutral.points_mm[person.landmarks68[39]][1];
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const float y = person.neutral.points_mm[atlas.triangles[t][i]][1];
      if (y < eyes && y > person.neutral.points_mm[person.landmarks68[8]][1] - 10) continue;
      const Vec2f& uv = atlas.uvs[atlas.corners[t][i]];
      map.albedo[static_cast<std::size_t>((1 - uv[1]) * 511) * 512 + static_cast<std::size_t>(uv[0] * 511)] = {
          0.01f, 0.01f, 0.01f};
    }
  EXPECT_NEAR(mouth_white(person, map, atlas, face, fit.light).colour[0], plain.colour[0], 0.01);
}

}  // namespace
