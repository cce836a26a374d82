// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/mouth.h"
#include "nodes/base/pose.h"
#include "nodes/model/fit_images.h"
#include "nodes/model/skin_basis.h"
#include "nodes/phantom/make_person.h"
#include "tests/nodes/model/material.h"
#include "tests/nodes/model/quiet_fit.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::model;

namespace {

struct Shot {
  Rig person;
  test::Scene scene;
  Image picture;
  Landmarks points;
};

// A person who is not in the model, with highlight, shadow, gamma and grain.
Shot shoot(std::int64_t person_seed, double yaw_deg) {
  static const ShapeSet modes = phantom::identity_modes({.with_hair = false});
  Shot shot;
  shot.person = phantom::make_person(test::head(), &modes, nullptr, {.seed = person_seed, .warp_mm = 0.7}).person;
  shot.scene = test::make_scene(yaw_deg);
  Weights rest;
  rest.values.assign(test::head().shapes.size(), 0.0f);
  shot.picture =
      phantom::video_frame(shot.person, rest, &shot.scene.world_from_head, shot.scene.camera, shot.scene.lighting,
                           nullptr, nullptr, nullptr, {.width_px = 480, .height_px = 480});
  shot.points = test::points_of(shot.scene, shot.person.neutral.points_mm, 0.7);
  return shot;
}

// Mean distance of the 68 points of two fits, from their middle; pairs: of these alone, each with its mirror image.
double distance_mm(const FaceFit& a, const FaceFit& b, const std::vector<std::size_t>& pairs) {
  const std::vector<Vec3f> from = pose_model(test::head_model(), a.identity, a.expression);
  const std::vector<Vec3f> to = pose_model(test::head_model(), b.identity, b.expression);
  std::vector<Vec3f> apart;
  Vec3f mean{};
  for (std::size_t i = 0; i < (pairs.empty() ? 68 : pairs.size()); ++i) {
    const Vec3f& p = from[test::head().landmarks68[pairs.empty() ? i : pairs[i]]];
    Vec3f q = to[test::head().landmarks68[pairs.empty() ? i : pairs[i ^ 1]]];
    if (!pairs.empty()) q[0] = -q[0];
    apart.push_back({p[0] - q[0], p[1] - q[1], p[2] - q[2]});
    for (std::size_t k = 0; k < 3; ++k) mean[k] += apart.back()[k];
  }
  double sum = 0;
  const auto count = static_cast<float>(apart.size());
  for (const Vec3f& d : apart)
    sum += std::hypot(d[0] - mean[0] / count, d[1] - mean[1] / count, d[2] - mean[2] / count);
  return sum / static_cast<double>(apart.size());
}

TEST(FitImage, FindsPoseAndAClosedMouthOfAPersonOutsideTheModel) {
  for (const double yaw_deg : {0.0, 25.0}) {
    const Shot shot = shoot(31, yaw_deg);
    const FaceFit fit = fit_image(test::head_model(), shot.picture, shot.points);
    EXPECT_TRUE(fit.converged) << fit.problem;
    EXPECT_LT(std::abs(fit.lip_gap_mm), 1.5) << yaw_deg;
    EXPECT_LT(test::turn_error_deg(fit.camera, shot.scene), 5.0)
        << yaw_deg;  // before any alignment of the head's frame
    EXPECT_LT(fit.image_rms, 0.02);
  }
}

// Lighter and darker bands that no component of the model has, as real skin, make-up and shadows of hair are.
TEST(FitImage, DoesNotBendTheShapeToExplainWhatNoComponentExplains) {
  Shot shot = shoot(31, 0);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 480; ++x)
      for (int c = 0; c < 3; ++c) {
        std::uint8_t& value = shot.picture.pixels[static_cast<std::size_t>((y * 480 + x) * 3 + c)];
        const double band = 1 + 0.12 * std::sin(0.21 * x + 0.05 * y) * std::sin(0.17 * y - 0.09 * x);
        value = static_cast<std::uint8_t>(std::clamp(value * band, 0.0, 255.0));
      }
  const FaceFit fit = fit_image(test::head_model(), shot.picture, shot.points);
  EXPECT_TRUE(fit.converged) << fit.problem;
  double squares = 0;
  for (const float c : fit.identity) squares += static_cast<double>(c) * c / static_cast<double>(fit.identity.size());
  EXPECT_LT(std::sqrt(squares), 1.0);  // coefficients are in standard deviations
  EXPECT_LT(std::abs(fit.lip_gap_mm), 1.5);
}

// A camera's gain is no property of the face.
TEST(FitImage, FindsTheSameFaceInADarkerPicture) {
  const Shot shot = shoot(33, -15);
  Image dark = shot.picture;
  for (std::uint8_t& value : dark.pixels) value = static_cast<std::uint8_t>(std::lround(0.4 * value));
  const FaceFit a = fit_image(test::head_model(), shot.picture, shot.points);
  const FaceFit b = fit_image(test::head_model(), dark, shot.points);
  EXPECT_TRUE(b.converged) << b.problem;
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(b.light.gain[c] / a.light.gain[c], 0.4, 0.04);
  // What is left is the rounding of the dark one to 8 bits.
  EXPECT_LT(distance_mm(a, b, {}), 0.5);
  EXPECT_NEAR(a.lip_gap_mm, b.lip_gap_mm, 0.3);
}

// How deep a fitted face is over its width: from the corners of the eyes to the tip of the nose.
double depth_of(const FaceFit& fit) {
  const std::vector<Vec3f> points = pose_model(test::head_model(), fit.identity, {});
  const auto at = [&](std::size_t mark) { return points[test::head().landmarks68[mark]]; };
  return (at(30)[2] - 0.5 * (at(36)[2] + at(45)[2])) / static_cast<double>(at(45)[0] - at(36)[0]);
}

// Without lobes of mirrored light the glossy head comes out 2 to 9 % deeper than the same head matt.
TEST(FitImage, DoesNotTakeAHighlightOnARidgeForRelief) {
  for (const std::int64_t seed : {31, 33, 35}) {
    Shot shot = shoot(seed, 10);
    Weights rest;
    rest.values.assign(test::head().shapes.size(), 0.0f);
    std::array<double, 2> depths{};
    for (const std::size_t glossy : {0u, 1u}) {
      for (Part& part : shot.person.neutral.parts) part.gloss = glossy == 1 ? 0.35f : 0.0f;
      const Image picture =
          phantom::video_frame(shot.person, rest, &shot.scene.world_from_head, shot.scene.camera, shot.scene.lighting,
                               nullptr, nullptr, nullptr, {.width_px = 480, .height_px = 480});
      const FaceFit fit = fit_image(test::head_model(), picture, shot.points);
      depths[glossy] = depth_of(fit);
      const float mirrored = fit.light.mirror[0] + fit.light.mirror[1];
      if (glossy == 1)
        EXPECT_GT(mirrored, 0.005f) << seed;
      else
        EXPECT_LT(mirrored, 0.001f) << seed;
    }
    // Which pixels are compared is drawn by lot: 0.5 % from that.
    EXPECT_NEAR(depths[1] / depths[0], 1, 0.015) << seed;
  }
}

// What the model knows of lips beyond the components that are fitted was written over the light, and past the end.
TEST(FitImage, FitsAFewExpressionsAsIfTheModelHadNoOthers) {
  const Shot shot = shoot(31, 10);
  MorphableModel small = test::head_model();
  ASSERT_GT(small.expression.size(), 2u);
  small.expression.names.resize(2);
  small.expression.sigmas.resize(2);
  small.expression.modes.resize(2 * small.mean.points_mm.size());
  const FaceFit a = fit_image(test::head_model(), shot.picture, shot.points, {.expressions = 2, .steps = 3});
  const FaceFit b = fit_image(small, shot.picture, shot.points, {.expressions = 2, .steps = 3});
  EXPECT_TRUE(a.converged) << a.problem;
  EXPECT_EQ(a.expression, b.expression);
  EXPECT_EQ(a.identity, b.identity);
  EXPECT_EQ(a.light.direction, b.light.direction);
}

// The same points under the names of the other side.
Landmarks mirrored(const Landmarks& landmarks, int width_px) {
  Landmarks result = landmarks;
  for (Landmark& point : result.points) {
    point.x_px = width_px - 1 - point.x_px;
    if (point.name.ends_with("_r") || point.name.ends_with("_l"))
      point.name.back() = point.name.back() == 'r' ? 'l' : 'r';
  }
  return result;
}

TEST(FitImage, OfAMirroredPictureIsTheMirroredFit) {
  const Shot shot = shoot(33, -15);
  Image picture = shot.picture;
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 480; ++x)
      for (int c = 0; c < 3; ++c)
        picture.pixels[static_cast<std::size_t>((y * 480 + x) * 3 + c)] =
            shot.picture.pixels[static_cast<std::size_t>((y * 480 + 479 - x) * 3 + c)];
  const FaceFit a = fit_image(test::head_model(), shot.picture, shot.points);
  const FaceFit b = fit_image(test::head_model(), picture, mirrored(shot.points, 480));
  EXPECT_TRUE(b.converged) << b.problem;
  // Of the head's z axis in the camera, x turns round. Other pixels are drawn by lot, so a little differs.
  for (const std::size_t i : {2u, 5u, 8u})
    EXPECT_NEAR(a.camera.cam_from_world[i], (i == 2 ? -1 : 1) * b.camera.cam_from_world[i], 0.03);
  EXPECT_LT(distance_mm(a, b, {36, 45, 39, 42, 30, 30, 48, 54, 8, 8, 31, 35, 19, 24}), 1.5);
  EXPECT_NEAR(a.lip_gap_mm, b.lip_gap_mm, 0.5);
}

TEST(FitImage, IsTheSameTwice) {
  const Shot shot = shoot(33, -15);
  const FaceFit a = fit_image(test::head_model(), shot.picture, shot.points, {.steps = 3});
  const FaceFit b = fit_image(test::head_model(), shot.picture, shot.points, {.steps = 3});
  EXPECT_EQ(a.identity, b.identity);
  EXPECT_EQ(a.camera.cam_from_world, b.camera.cam_from_world);
  EXPECT_EQ(a.light.ambient, b.light.ambient);
}

TEST(FitImages, SharesIdentityAndAlbedoAmongPicturesOfOnePerson) {
  const Shot front = shoot(34, 0), side = shoot(34, 30);
  const std::vector<FaceFit> fits =
      fit_pictures(test::head_model(), {&front.picture, &side.picture}, {&front.points, &side.points}, {.steps = 4});
  ASSERT_EQ(fits.size(), 2u);
  EXPECT_EQ(fits[0].identity, fits[1].identity);
  EXPECT_EQ(fits[0].albedo, fits[1].albedo);
  EXPECT_LT(test::turn_error_deg(fits[1].camera, side.scene), 6.0);
  EXPECT_LT(test::turn_error_deg(fits[0].camera, front.scene), 6.0);
}

// Light and skin explain a wall without any error.
TEST(FitImage, DoesNotSeeAFaceOnAWall) {
  const Shot shot = shoot(35, 0);
  Image wall = test::blank(480, 480);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 480; ++x)
      for (int c = 0; c < 3; ++c)
        wall.pixels[static_cast<std::size_t>((y * 480 + x) * 3 + c)] = static_cast<std::uint8_t>(80 + x / 5 + 10 * c);
  const FaceFit fit = fit_image(test::head_model(), wall, shot.points);
  EXPECT_FALSE(fit.converged);
  EXPECT_EQ(fit.problem,
            "what is at the points does not look like a face (likeness 0, expected at least 0.26): use points of this "
            "picture, on a face that is upright and not hidden");
}

TEST(FitImage, DoesNotSeeAFaceInADarkPicture) {
  const Shot shot = shoot(35, 0);
  const FaceFit fit = fit_image(test::head_model(), test::blank(480, 480, 2), shot.points, {.steps = 3});
  EXPECT_FALSE(fit.converged);
  EXPECT_EQ(fit.problem, "100 % of the face is all but black: use a picture with more light");
}

struct Heard : engine::Progress {
  void warn(const std::string& text) override { texts.push_back(text); }
  std::vector<std::string> texts;
};

// Five mouths were drawn into a picture by such a fit, and nothing was said.
TEST(FitImage, WarnsOfAFitThatIsNotToBeUsed) {
  Heard heard;
  const Shot shot = shoot(35, 0);
  fit_image(test::head_model(), test::blank(480, 480, 2), shot.points, {.steps = 3}, heard);
  EXPECT_EQ(heard.texts,
            std::vector<std::string>{"the fit is not to be used: 100 % of the face is all but black: use a "
                                     "picture with more light"});
  heard.texts.clear();
  EXPECT_TRUE(fit_image(test::head_model(), shot.picture, shot.points, {.steps = 3}, heard).converged);
  EXPECT_TRUE(heard.texts.empty());
}

TEST(FitImage, DoesNotSeeAFaceInAnOverexposedPicture) {
  const Shot shot = shoot(35, 0);
  const FaceFit fit = fit_image(test::head_model(), test::blank(480, 480, 255), shot.points, {.steps = 3});
  EXPECT_FALSE(fit.converged);
  EXPECT_EQ(fit.problem, "100 % of the face is overexposed: use a picture with less or softer light");
}

TEST(FitImage, DoesNotSeeAFaceInNoise) {
  const Shot shot = shoot(35, 0);
  Image noise = test::blank(480, 480);
  Random random(1);
  for (std::uint8_t& value : noise.pixels) value = static_cast<std::uint8_t>(random.uniform(0, 255));
  for (int y = 0; y < 480; ++y)  // in blocks, or the pyramid would even it out
    for (int x = 0; x < 480; ++x)
      for (int c = 0; c < 3; ++c)
        noise.pixels[static_cast<std::size_t>((y * 480 + x) * 3 + c)] =
            noise.pixels[static_cast<std::size_t>((y / 24 * 24 * 480 + x / 24 * 24) * 3 + c)];
  const FaceFit fit = fit_image(test::head_model(), noise, shot.points, {.steps = 3});
  EXPECT_FALSE(fit.converged);
  EXPECT_NE(fit.problem.find("is there a face at the points?"), std::string::npos) << fit.problem;
}

TEST(FitImages, SaysThatPointsOfAnotherPictureSpoilAll) {
  const Shot shot = shoot(35, 0);
  Landmarks few = shot.points;
  few.points.resize(3);
  const std::vector<FaceFit> fits =
      fit_pictures(test::head_model(), {&shot.picture, &shot.picture}, {&shot.points, &few}, {.steps = 1});
  EXPECT_FALSE(fits[0].converged);
  EXPECT_EQ(fits[0].problem, "the points of another picture of this person could not be used");
  EXPECT_FALSE(fits[1].problem.empty());
}

TEST(FitImages, KeepsTheIdsOfThePicturesAndWarnsOfEachThatIsNotToBeUsed) {
  const Shot shot = shoot(35, 0);
  Landmarks few = shot.points;
  few.points.resize(3);
  Heard heard;
  const engine::Seq<FaceFit> fits = fit_images(test::head_model(), engine::Seq<Image>({shot.picture}, {"front"}),
                                               engine::Seq<Landmarks>({few}, {"front"}), {.steps = 1}, heard);
  EXPECT_EQ(fits.id(0), "front");
  EXPECT_FALSE(fits.at(0)->converged);
  EXPECT_EQ(heard.texts,
            std::vector<std::string>{"the fit of picture front is not to be used: " + fits.at(0)->problem});
}

TEST(FitImages, RejectsUnequalCounts) {
  const Image picture = test::blank(10, 10);
  EXPECT_THROW_TEXT(fit_pictures(test::head_model(), {&picture}, {}, {}), "there are 1 pictures and 0 sets of points");
}

}  // namespace
