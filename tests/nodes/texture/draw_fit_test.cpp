// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/draw_fit.h"

#include <gtest/gtest.h>

#include "tests/nodes/model/material.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::texture;

namespace {

FaceFit frontal() {
  FaceFit fit;
  fit.camera = test::make_scene(0, 160, 160).camera;
  fit.image_width_px = fit.image_height_px = 160;
  return fit;
}

TEST(DrawFit, DrawsTheFaceAndNothingElse) {
  const Image image = draw_fit(test::head_model(), frontal(), test::blank(160, 160, 10), {.opacity = 1});
  EXPECT_GT(image.pixels[3 * (80 * 160 + 80)], 60);
  EXPECT_EQ(image.pixels[0], 10);
}

TEST(DrawFit, LeavesThePictureWhereItIsTransparent) {
  const Image paper = test::blank(160, 160, 10);
  EXPECT_EQ(draw_fit(test::head_model(), frontal(), paper, {.opacity = 0}).pixels, paper.pixels);
}

TEST(DrawFit, RejectsAPictureOfAnotherSize) {
  EXPECT_THROW_TEXT(draw_fit(test::head_model(), frontal(), test::blank(8, 8)),
                    "the picture is 8 x 8 pixels, the fit was made on 160 x 160");
}

}  // namespace
