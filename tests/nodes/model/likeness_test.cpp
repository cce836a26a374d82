// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/likeness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "nodes/model/face_pose.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/skin_basis.h"
#include "tests/nodes/model/material.h"

namespace face::model {
namespace {

// The mean head in front of the camera, its mouth as wide open as one component opens it, and a picture of it in grey.
struct World {
  SkinBasis basis = make_skin_basis(test::head_model(), 0, 4, 0);
  std::vector<double> identity;
  PictureState state;
  cv::Mat picture;

  World() {
    state.pose = test::pose_in_front();
    float widest = 0;
    for (std::size_t k = 0; k < 4; ++k)
      for (const float sigmas : {-2.5f, 2.5f}) {
        std::vector<float> expression(4, 0.0f);
        expression[k] = sigmas;
        const float gap = static_cast<float>(lip_gap_of(test::head_model(), expression));
        if (gap <= widest) continue;
        widest = gap;
        state.expression.assign(expression.begin(), expression.end());
      }
    picture = cv::Mat(240, 240, CV_8UC3, cv::Scalar::all(150));
    fill(36, 6, 60);
    fill(42, 6, 60);
  }
  // Paints what lies within some of the 68 points, from `first` on, without its rim.
  void fill(std::size_t first, std::size_t count, int value) {
    const std::vector<Vec3f> posed =
        pose_model(test::head_model(), {}, {state.expression.begin(), state.expression.end()});
    std::vector<Vec3f> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(posed[test::head().landmarks68[first + i]]);
    std::vector<cv::Point> outline;
    cv::Point2f middle(0, 0);
    const std::vector<render::ScreenPoint> seen = render::project(camera_of(state.pose), points);
    for (const render::ScreenPoint& p : seen) middle += cv::Point2f(p.x_px, p.y_px) / static_cast<float>(count);
    for (const render::ScreenPoint& p : seen)
      outline.emplace_back(middle + 0.6f * (cv::Point2f(p.x_px, p.y_px) - middle));
    cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{outline}, cv::Scalar::all(value));
  }
  double likeness() const {
    Image image{240, 240, 3, {picture.data, picture.data + picture.total() * 3}};
    return model::likeness({test::head_model(), basis, identity, state, 100}, make_level(image, 0.55));
  }
};

TEST(Likeness, KnowsEyesByTheirDarkness) {
  World dark, bright;
  bright.fill(36, 6, 240);
  bright.fill(42, 6, 240);
  EXPECT_GT(dark.likeness(), 0.3);
  EXPECT_LT(bright.likeness(), 0);
}

TEST(Likeness, LeavesOutWhatLiesBetweenLips) {
  World teeth, hollow;
  teeth.fill(60, 8, 250);
  hollow.fill(60, 8, 5);
  EXPECT_NEAR(teeth.likeness(), hollow.likeness(), 0.02);
}

TEST(Likeness, IsNothingWhereNoFaceIsDrawn) {
  World aside;
  aside.state.pose.u_px = -2000;
  EXPECT_EQ(aside.likeness(), 0);
}

}  // namespace
}  // namespace face::model
