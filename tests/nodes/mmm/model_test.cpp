// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "engine/port.h"
#include "nodes/evaluate/picture.h"
#include "nodes/mmm/analyse.h"
#include "nodes/mmm/build.h"
#include "nodes/mmm/image_points.h"
#include "nodes/mmm/morph.h"
#include "nodes/mmm/rebuild_pca.h"
#include "nodes/mmm/synthesise.h"
#include "tests/nodes/mmm/mouths.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

engine::Seq<Image> corpus() {
  std::vector<Image> images;
  for (const double wide : {0.9, 1.1})
    for (const double open : {0.0, 0.35, 0.7}) images.push_back(test::painted_mouth(open, wide));
  return images;
}

const Mmm& model() {
  engine::Progress progress;
  static const Mmm made = build(corpus(), Matrix{6, 1, {0, 1, 2, 3, 4, 5}}, progress);
  return made;
}

double psnr_db(const Image& truth, const Image& made) {
  return evaluate::picture(made, truth, nullptr).rows[0].values[1];
}

TEST(Mmm, GivesItsPrototypesBack) {
  for (std::size_t i = 0; i < 6; ++i) {
    Weights at{std::vector<float>(12, 0)};
    at.values[i] = at.values[6 + i] = 1;
    // Interpolation at an inverse that is good to 0.01 px, where flows do not fold.
    EXPECT_GT(psnr_db(model().prototypes[i].image, synthesise(model(), at)), 34) << i;
  }
}

TEST(Mmm, TheReferenceIsAtAlphaNullExactly) {
  Weights at{std::vector<float>(12, 0)};
  const auto r = static_cast<std::size_t>(model().reference);
  at.values[6 + r] = 1;
  EXPECT_EQ(synthesise(model(), at).pixels, model().prototypes[r].image.pixels);
}

TEST(Mmm, FindsAPrototypeWhereItIs) {
  const std::size_t i = model().reference == 5 ? 0 : 5;
  const Weights found = analyse(model(), model().prototypes[i].image).parameters;
  ASSERT_EQ(found.values.size(), 12u);
  double sum = 0;
  for (std::size_t b = 6; b < 12; ++b) {
    EXPECT_GE(found.values[b], 0);
    sum += static_cast<double>(found.values[b]);
  }
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_GT(found.values[6 + i], 0.8f);
}

TEST(Mmm, MakesAPictureThatItHasNotSeenBetterAndSharperThanPrincipalComponents) {
  const Image unseen = test::painted_mouth(0.52, 1.0);
  const Image made = synthesise(model(), analyse(model(), unseen).parameters);
  std::vector<Image> rebuilt;
  engine::SeqWriter<Image> writer([&](std::string, Image image) { rebuilt.push_back(std::move(image)); });
  rebuild_pca(corpus(), std::vector<Image>{unseen}, writer, {12});
  const Table mmm = evaluate::picture(made, unseen, nullptr), pca = evaluate::picture(rebuilt.at(0), unseen, nullptr);
  RecordProperty("mmm_psnr_db", std::to_string(mmm.rows[0].values[1]));
  RecordProperty("pca_psnr_db", std::to_string(pca.rows[0].values[1]));
  EXPECT_GT(mmm.rows[0].values[1], pca.rows[0].values[1] + 1);
  EXPECT_GT(mmm.rows[0].values[2], pca.rows[0].values[2]);
}

TEST(Mmm, RefusesAnotherSizeAndAnotherCount) {
  Image small = test::painted_mouth(0, 1);
  small.height = 63;
  small.pixels.resize(3 * 96 * 63);
  EXPECT_THROW_TEXT(analyse(model(), small), "image is 96 x 63 pixels, the model is 96 x 64");
  EXPECT_THROW_TEXT(synthesise(model(), Weights{{1, 2, 3}}), "there are 3 parameters, expected 12 for 6 prototypes");
  engine::Progress progress;
  EXPECT_THROW_TEXT(build(corpus(), Matrix{1, 1, {6}}, progress), "exemplar 0 is image 6, expected one of 6");
  EXPECT_THROW_TEXT(build(corpus(), Matrix{}, progress), "there are no exemplars, expected at least one");
}

TEST(Mmm, WarnsWhereNoMouthMoves) {
  class Listener : public engine::Progress {
   public:
    void warn(const std::string& text) override { heard.push_back(text); }
    std::vector<std::string> heard;
  } listener;
  const engine::Seq<Image> still(std::vector<Image>(3, test::painted_mouth(0.3, 1)));
  build(still, Matrix{2, 1, {0, 2}}, listener);
  EXPECT_EQ(listener.heard,
            (std::vector<std::string>{
                "the pictures hardly differ (by 0 grey values RMS at most): there is no mouth in them, or it does not "
                "move"}));
  listener.heard.clear();
  build(corpus(), Matrix{6, 1, {0, 1, 2, 3, 4, 5}}, listener);
  EXPECT_TRUE(listener.heard.empty());
}

TEST(InvertFlow, IsTheInverseOfASmoothFlow) {
  std::vector<Vec2f> flow;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 50; ++x)
      flow.push_back({static_cast<float>(3 * std::sin(0.1 * y)), static_cast<float>(2 * std::cos(0.12 * x))});
  const std::vector<Vec2f> inverse = invert_flow(flow, 50, 40);
  for (int y = 5; y < 35; ++y)
    for (int x = 5; x < 45; ++x) {
      const Vec2f& from = inverse[static_cast<std::size_t>(y * 50 + x)];
      // 0.01 px of the stop and what bilinear interpolation of the flow leaves, 3 * 0.1^2 / 8.
      EXPECT_NEAR(static_cast<double>(from[0]) + 3 * std::sin(0.1 * static_cast<double>(from[1])), x, 0.02);
      EXPECT_NEAR(static_cast<double>(from[1]) + 2 * std::cos(0.12 * static_cast<double>(from[0])), y, 0.02);
    }
}

TEST(ImagePoints, AreApartAsPicturesAre) {
  const Matrix points = image_points(corpus(), {3, 32, false});
  ASSERT_EQ(points.rows, 6u);
  const auto apart = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t k = 0; k < points.columns; ++k) sum += std::pow(points.at(a, k) - points.at(b, k), 2);
    return sum;
  };
  EXPECT_LT(apart(0, 1), apart(0, 2));
  EXPECT_LT(apart(3, 4), apart(3, 5));
}

}  // namespace
}  // namespace face::mmm
