// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/fit_landmarks.h"

#include <gtest/gtest.h>

#include "nodes/decode/read_landmarks.h"
#include "nodes/model/name_landmark.h"
#include "tests/nodes/model/material.h"
#include "tests/support/expect_throw_text.h"

using namespace face;
using namespace face::model;

namespace {

const Image& canvas() {
  static const Image image = test::blank(480, 480);
  return image;
}

TEST(FitLandmarks, FindsThePoseOfAKnownHead) {
  for (const double yaw_deg : {-40.0, 0.0, 25.0}) {
    const test::Scene scene = test::make_scene(yaw_deg);
    const Landmarks points = test::points_of(scene, test::head().neutral.points_mm, 0);
    const FaceFit fit = fit_landmarks(test::head_model(), points, canvas());
    EXPECT_TRUE(fit.converged) << fit.problem;
    EXPECT_LT(test::turn_error_deg(fit.camera, scene), 3.0)
        << yaw_deg;  // 16 points leave shape, focal length and pose some play
    EXPECT_LT(fit.landmark_nme, 0.01);
  }
}

TEST(FitLandmarks, LeavesAClosedMouthClosedUnderNoise) {
  const test::Scene scene = test::make_scene(10);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const FaceFit fit =
        fit_landmarks(test::head_model(), test::points_of(scene, test::head().neutral.points_mm, 1.0, seed), canvas());
    EXPECT_LT(std::abs(fit.lip_gap_mm), 1.0) << seed;
  }
}

TEST(FitLandmarks, SeesAnOpenMouth) {
  const MorphableModel& model = test::head_model();
  std::vector<float> expression(model.expression.size(), 0.0f);
  expression[0] = 1.5f;
  if (lip_gap_of(model, expression) < 0) expression[0] = -1.5f;
  const double truth_mm = lip_gap_of(model, expression);
  ASSERT_GT(truth_mm, 5.0);
  const FaceFit fit =
      fit_landmarks(model, test::points_of(test::make_scene(0), pose_model(model, {}, expression), 0.3), canvas());
  EXPECT_NEAR(fit.lip_gap_mm, truth_mm, 0.3 * truth_mm);
}

TEST(FitLandmarks, IsUnchangedWhenThePictureIsTwiceAsLarge) {
  const Landmarks small = test::points_of(test::make_scene(15), test::head().neutral.points_mm, 0.5);
  Landmarks large = small;
  for (Landmark& point : large.points) {
    point.x_px = 2 * (point.x_px + 0.5) - 0.5;
    point.y_px = 2 * (point.y_px + 0.5) - 0.5;
  }
  const FaceFit a = fit_landmarks(test::head_model(), small, canvas());
  const FaceFit b = fit_landmarks(test::head_model(), large, test::blank(960, 960));
  for (std::size_t k = 0; k < a.identity.size(); ++k) EXPECT_NEAR(a.identity[k], b.identity[k], 1e-3);
  EXPECT_NEAR(2 * a.camera.focal_px, b.camera.focal_px, 1.0);
}

TEST(FitLandmarks, SaysThatTooFewPointsAreTooFew) {
  Landmarks points = test::points_of(test::make_scene(0), test::head().neutral.points_mm, 0);
  points.points.resize(4);
  const FaceFit fit = fit_landmarks(test::head_model(), points, canvas());
  EXPECT_FALSE(fit.converged);
  EXPECT_EQ(fit.problem,
            "found 4 points besides those on the outline, expected at least 6: add corners of eyes and mouth, nose "
            "tip, chin");
}

TEST(FitLandmarks, NamesPointsThatLieOutsideThePicture) {
  const Landmarks points = test::points_of(test::make_scene(0), test::head().neutral.points_mm, 0);
  const FaceFit fit = fit_landmarks(test::head_model(), points, test::blank(240, 480));  // half of the picture
  EXPECT_FALSE(fit.converged);
  EXPECT_EQ(fit.problem,
            "the picture is 240 x 480 pixels, but outside of it are eye_inner_l, eye_outer_l, nose_wing_l, "
            "mouth_corner_l, brow_outer_l, brow_inner_l: use the points of this picture, and one that shows the whole "
            "face");
}

TEST(FitLandmarks, NamesPointsThatContradictTheOthers) {
  Landmarks points = test::points_of(test::make_scene(0), test::head().neutral.points_mm, 0);
  std::swap(points.points[4].x_px, points.points[0].x_px);
  std::swap(points.points[4].y_px, points.points[0].y_px);
  const FaceFit fit = fit_landmarks(test::head_model(), points, canvas());
  EXPECT_FALSE(fit.converged);
  EXPECT_NE(fit.problem.find("the points contradict each other; check these: eye_outer_r"), std::string::npos)
      << fit.problem;
}

TEST(FitLandmarks, SaysThatPointsAtOnePlaceAreNoFace) {
  Landmarks points = test::points_of(test::make_scene(0), test::head().neutral.points_mm, 0);
  for (Landmark& point : points.points) point.x_px = point.y_px = 100;
  const FaceFit fit = fit_landmarks(test::head_model(), points, canvas());
  EXPECT_FALSE(fit.converged);
  EXPECT_EQ(fit.problem, "the points all lie at one place: place them on the features they are named after");
}

TEST(FitLandmarks, DoesNotBelieveAProfile) {
  const FaceFit fit = fit_landmarks(test::head_model(),
                                    test::points_of(test::make_scene(80), test::head().neutral.points_mm, 0), canvas());
  EXPECT_FALSE(fit.converged);
  EXPECT_NE(fit.problem.find("use a picture in which both eyes are seen"), std::string::npos) << fit.problem;
}

TEST(FitLandmarks, RejectsANameThatNoModelKnows) {
  EXPECT_THROW_TEXT(name_landmark(test::head_model(), "elbow"),
                    "the point \"elbow\" has a name that no model knows, expected eye_inner_r, mouth_corner_l, "
                    "nose_tip, chin, lip_0 to lip_11, jaw_r, cheek_l, contour_1, 0 to 67 (Multi-PIE), vertex_N or the "
                    "like");
}

TEST(NameLandmark, KnowsNumbersNamesVerticesAndTheOutline) {
  const MorphableModel& model = test::head_model();
  EXPECT_EQ(name_landmark(model, "chin").vertex, model.landmarks68[8]);
  EXPECT_EQ(name_landmark(model, "36").vertex, model.landmarks68[36]);
  EXPECT_EQ(name_landmark(model, "lip_6").vertex, model.landmarks68[54]);
  EXPECT_EQ(name_landmark(model, "vertex_77").vertex, 77u);
  EXPECT_TRUE(name_landmark(model, "jaw_r").contour);
  EXPECT_TRUE(name_landmark(model, "3").contour);
}

}  // namespace
