// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/from_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/nodes/model/material.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::model;

namespace {

TEST(FromRig, WithAllCoefficientsZeroIsTheRigsNeutral) {
  EXPECT_EQ(pose_model(test::head_model(), {}, {}), test::head().neutral.points_mm);
}

TEST(FromRig, KeepsIdentityModesAsTheyAre) {
  const ShapeSet modes = phantom::identity_modes({.with_hair = false});
  const MorphableModel& model = test::head_model();
  ASSERT_EQ(model.identity.size(), modes.shapes.size());
  const Shape& mode = modes.shapes[3];
  for (std::size_t i = 0; i < mode.vertices.size(); i += 97)
    EXPECT_EQ(model.identity.modes[3 * model.mean.points_mm.size() + mode.vertices[i]], mode.offsets_mm[i]);
}

TEST(FromRig, MakesExpressionsOrthogonalOverTheSkinAndLargestFirst) {
  const MorphableModel& model = test::head_model();
  const std::size_t vertices = model.mean.points_mm.size();
  ASSERT_EQ(model.expression.size(), 10u);
  std::vector<double> norms;
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a; b < 4; ++b) {
      double dot = 0;
      const Part& face_part = model.mean.parts.front();
      std::vector<bool> skin(vertices, false);
      ASSERT_EQ(face_part.name, "face");
      for (std::size_t c = model.mean.polygon_starts[face_part.first_polygon];
           c < model.mean.polygon_starts[face_part.first_polygon + face_part.polygon_count]; ++c)
        skin[model.mean.corners[c]] = true;
      for (std::size_t v = 0; v < vertices; ++v)
        if (skin[v])
          for (std::size_t k = 0; k < 3; ++k)
            dot += static_cast<double>(model.expression.modes[a * vertices + v][k]) *
                   model.expression.modes[b * vertices + v][k];
      if (a == b)
        norms.push_back(dot);
      else
        EXPECT_LT(std::abs(dot), 1e-3 * norms.front());  // floats summed over the skin
    }
  for (std::size_t i = 1; i < norms.size(); ++i) EXPECT_LE(norms[i], norms[i - 1]);
}

TEST(FromRig, IsTheSameTwice) {
  const MorphableModel again = from_rig(test::head(), nullptr, {.albedos = 9, .samples = 50, .skins = 0, .seed = 5});
  const MorphableModel once = from_rig(test::head(), nullptr, {.albedos = 9, .samples = 50, .skins = 0, .seed = 5});
  EXPECT_EQ(once.expression.modes, again.expression.modes);
  EXPECT_EQ(once.albedo.modes, again.albedo.modes);
  EXPECT_EQ(once.identity.size(), 0u);
}

TEST(FromRig, RejectsModesOfAnotherRig) {
  ShapeSet modes;
  modes.shapes.push_back({"wide", {1000000}, {{1, 0, 0}}});
  EXPECT_THROW_TEXT(from_rig(test::head(), &modes, {.samples = 2, .skins = 0}),
                    "identity mode \"wide\" moves vertex 1000000, but the rig has " +
                        std::to_string(test::head().neutral.points_mm.size()));
}

}  // namespace
