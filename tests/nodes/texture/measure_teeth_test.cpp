// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/measure_teeth.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "nodes/model/pose_model.h"
#include "nodes/texture/draw_face.h"
#include "nodes/texture/face_mask.h"
#include "nodes/texture/lay_over.h"
#include "nodes/texture/render_into.h"
#include "tests/nodes/texture/drawn_face.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::texture;
using namespace test;

namespace {

// A smile whose teeth are drawn with a gain, and its fit.
struct Smile {
  const MorphableModel& model = test::head_model();
  FaceFit fit = true_fit(0);
  AlbedoMap map = striped_map();
  Smile() {
    fit.lip_gap_mm = 8;
    fit.expression = expression_of(teeth_shown());
    std::fill(map.albedo.begin(), map.albedo.end(), Vec3f{0.3f, 0.18f, 0.1f});
  }
  static Weights teeth_shown() {
    Weights weights = open_mouth(0.25f);
    for (std::size_t s = 0; s < weights.values.size(); ++s)
      for (const char* name : {"mouthUpperUp", "mouthLowerDown", "mouthSmile"})
        if (test::head().shapes[s].name.starts_with(name)) weights.values[s] = 0.7f;
    return weights;
  }
  // The model's expression nearest to weights, by its modes' own sizes.
  std::vector<float> expression_of(const Weights& weights) const {
    const std::vector<Vec3f> posed = pose_points(test::head(), weights);
    const std::size_t vertices = posed.size();
    std::vector<float> result(model.expression.size(), 0.0f);
    for (std::size_t k = 0; k < result.size(); ++k) {
      double along = 0, length = 0;
      for (std::size_t v = 0; v < vertices; ++v)
        for (std::size_t c = 0; c < 3; ++c) {
          const double mode = static_cast<double>(model.expression.modes[k * vertices + v][c]);
          along += mode * static_cast<double>(posed[v][c] - model.mean.points_mm[v][c]);
          length += mode * mode;
        }
      result[k] = static_cast<float>(along / length);
    }
    return result;
  }
  Image picture(const Vec3f& teeth_gain) const {
    const std::vector<Vec3f> points = model::pose_model(model, fit.identity, fit.expression);
    const Image paper = test::blank(320, 320, 90);
    return lay_over(draw_face(test::head(), map, points, points, fit, {.samples = 3, .teeth_gain = teeth_gain}), paper,
                    paper, face_mask(model, fit), 1);
  }
};

// Dark faces smiled with teeth as dark as their skin.
TEST(MeasureTeeth, FindsHowMuchBrighterTheyAre) {
  const Smile smile;
  const Matrix gain = measure_teeth(smile.model, test::head(), smile.map, smile.fit, smile.picture({1.2f, 1.4f, 1.6f}));
  ASSERT_EQ(gain.values.size(), 3u);
  EXPECT_NEAR(gain.values[0], 1.2, 0.1);
  EXPECT_NEAR(gain.values[1], 1.4, 0.12);
  EXPECT_NEAR(gain.values[2], 1.6, 0.15);
}

TEST(MeasureTeeth, IsOneWhereNoneAreSeen) {
  Smile smile;
  const Image dark = smile.picture({0.2f, 0.2f, 0.2f});
  const Matrix ones{1, 3, {1, 1, 1}};
  EXPECT_EQ(measure_teeth(smile.model, test::head(), smile.map, smile.fit, dark).values, ones.values);
  const Image bright = smile.picture({1.2f, 1.4f, 1.6f});
  smile.fit.lip_gap_mm = 0.5;
  EXPECT_EQ(measure_teeth(smile.model, test::head(), smile.map, smile.fit, bright).values, ones.values);
}

TEST(MeasureTeeth, GivesDrawnTeethTheirBrightness) {
  const Smile smile;
  const Image picture = smile.picture({1.2f, 1.4f, 1.6f});
  const Matrix gain = measure_teeth(smile.model, test::head(), smile.map, smile.fit, picture);
  const auto with = [&](const Matrix* teeth) {
    return render_into(smile.model, test::head(), smile.map, smile.fit, picture, nullptr, nullptr, teeth).pixels;
  };
  const std::vector<std::uint8_t> plain = with(nullptr), bright = with(&gain);
  double sum = 0, before = 0;
  std::size_t changed = 0;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_GE(bright[i], plain[i]) << i;
    if (bright[i] < plain[i] + 8) continue;
    ++changed;
    sum += bright[i];
    before += plain[i];
  }
  EXPECT_GT(changed, 50u);
  EXPECT_GT(sum, 1.15 * before);
}

TEST(MeasureTeeth, RejectsAPictureOfAnotherSizeAndAGainOfAnotherForm) {
  const Smile smile;
  EXPECT_THROW_TEXT(measure_teeth(smile.model, test::head(), smile.map, smile.fit, test::blank(10, 10)),
                    "the picture is 10 x 10 pixels, the fit was made on 320 x 320");
  const Matrix two{1, 2, {1, 1}};
  EXPECT_THROW_TEXT(gain_of(&two), "teeth is 1 x 2, expected 1 x 3");
  EXPECT_EQ(gain_of(nullptr), (Vec3f{1, 1, 1}));
}

}  // namespace
