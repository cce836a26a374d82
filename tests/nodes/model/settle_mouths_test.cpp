// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/settle_mouths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "nodes/base/mouth.h"
#include "nodes/base/pose.h"
#include "nodes/model/fit_image.h"
#include "nodes/model/pose_model.h"
#include "nodes/phantom/make_person.h"
#include "tests/nodes/model/material.h"
#include "tests/nodes/model/quiet_fit.h"

using namespace face;
using namespace face::model;

namespace {

// A person who is not in the model, photographed with lips this far apart, mm.
Image photograph(const Rig& person, const test::Scene& scene, double gap_mm) {
  Weights weights;
  weights.values.assign(test::head().shapes.size(), 0.0f);
  for (std::size_t s = 0; s < weights.values.size() && gap_mm > 0; ++s) {
    if (test::head().shapes[s].name != "jawOpen") continue;
    weights.values[s] = 1;
    weights.values[s] = static_cast<float>(gap_mm / lip_gap_mm(person, pose_points(person, weights)));
  }
  return phantom::video_frame(person, weights, &scene.world_from_head, scene.camera, scene.lighting, nullptr, nullptr,
                              nullptr, {.width_px = 480, .height_px = 480});
}

struct Sitter {
  Rig person;
  test::Scene scene = test::make_scene(0);
  Image shut;
  FaceFit fit;  // of the shut mouth
};

const Sitter& sitter() {
  static const Sitter one = [] {
    Sitter made;
    const ShapeSet modes = phantom::identity_modes({.with_hair = false});
    made.person = phantom::make_person(test::head(), &modes, nullptr, {.seed = 31, .warp_mm = 0.7}).person;
    made.shut = photograph(made.person, made.scene, 0);
    made.fit =
        fit_image(test::head_model(), made.shut, test::points_of(made.scene, made.person.neutral.points_mm, 0.7));
    return made;
  }();
  return one;
}

// A fit in which the mouth is open, and what it costs more to shut it.
class Doubt {
 public:
  // true_gap_mm: of the photograph; fitted_gap_mm: of the fit; excess: of the cost of the shut mouth over the open
  // one's.
  Doubt(double true_gap_mm, double fitted_gap_mm, double excess) {
    const MorphableModel& model = test::head_model();
    const FaceFit& fit = sitter().fit;
    joint_.model = &model;
    joint_.basis = make_skin_basis(model, fit.identity.size(), fit.expression.size(), fit.albedo.size());
    joint_.identity.assign(fit.identity.begin(), fit.identity.end());
    joint_.albedo.assign(fit.albedo.begin(), fit.albedo.end());
    joint_.gaps = lip_gap_rows(model);
    Picture& picture = joint_.pictures.emplace_back();
    picture.state.pose = pose_of(fit.camera, turning_point(model));
    picture.state.light = light_ = fit.light;
    shut_.assign(fit.expression.begin(), fit.expression.end());
    picture.state.expression = opened(shut_, -gap(shut_));
    shut_ = picture.state.expression;
    picture.state.expression = opened(shut_, fitted_gap_mm);
    const Image open = photograph(sitter().person, sitter().scene, true_gap_mm);
    levels_ = {make_level(true_gap_mm > 0 ? open : sitter().shut, 0.8)};
    // The excess comes of a gain that is a little off, in the shut one's fit or in the open one's.
    double low = -0.5, high = 0.5;
    for (int i = 0; i < 14; ++i) {
      off_ = 0.5 * (low + high);
      (excess_now() < excess ? low : high) = off_;
    }
    if (off_ < 0) worsen(joint_);
  }

  // The lip gap when it has been settled, mm.
  double settled_mm() {
    settle_mouths(
        levels_, [this](Joint& tried) { run(tried); }, joint_);
    return gap_of(joint_, 0);
  }

 private:
  double gap(const std::vector<double>& expression) const {
    double sum = 0;
    const std::vector<double> row = mean_gap_row(joint_);
    for (std::size_t k = 0; k < row.size(); ++k) sum += row[k] * expression[k];
    return sum;
  }

  // Opened in the likeliest way.
  std::vector<double> opened(std::vector<double> expression, double by_mm) const {
    const std::vector<double> row = mean_gap_row(joint_);
    double strength = 0;
    for (std::size_t k = 0; k < row.size(); ++k) strength += std::pow(row[k] * joint_.model->expression.sigmas[k], 2);
    for (std::size_t k = 0; k < row.size(); ++k)
      expression[k] += by_mm * row[k] * std::pow(joint_.model->expression.sigmas[k], 2) / strength;
    return expression;
  }

  void worsen(Joint& joint) const {
    for (float& gain : joint.pictures[0].state.light.gain) gain *= 1 + static_cast<float>(std::abs(off_));
  }

  void run(Joint& tried) const {
    if (!tried.pictures[0].closed) return;
    tried.pictures[0].state.expression = shut_;
    tried.pictures[0].state.light = light_;
    if (off_ > 0) worsen(tried);
  }

  double excess_now() const {
    Joint open = joint_, closed = joint_;
    if (off_ < 0) worsen(open);
    closed.pictures[0].closed = true;
    run(closed);
    return image_cost(closed, 0, levels_[0]) / image_cost(open, 0, levels_[0]) - 1;
  }

  Joint joint_;
  std::vector<PictureLevel> levels_;
  std::vector<double> shut_;
  FaceLight light_;
  double off_ = 0;
};

// A made person's mouth was 1.6 mm open, as shutting it cost 6.3 %; all that is between its lips is lips.
TEST(SettleMouths, ShutsLipsBetweenWhichAreLipsAtUpToATenthMore) {
  EXPECT_LT(Doubt(0, 3.8, 0.08).settled_mm(), 0.1);
  EXPECT_NEAR(Doubt(0, 3.8, 0.13).settled_mm(), 3.8, 1e-6);
}

// Where the dark line between lips is half of what lies between them, doubt is left: as much is too much.
TEST(SettleMouths, LeavesAMouthOpenAtMoreThanASixteenthWhereItMayBeNoLips) {
  EXPECT_LT(Doubt(0, 2, 0.04).settled_mm(), 0.1);
  EXPECT_NEAR(Doubt(0, 2, 0.08).settled_mm(), 2, 1e-6);
}

TEST(SettleMouths, LeavesAMouthOpenWhereTheInsideShowsBetweenItsLips) {
  EXPECT_NEAR(Doubt(3, 3, 0.08).settled_mm(), 3, 1e-6);
}

TEST(SettleMouths, ShutsALineBetweenLipsAtUpToATenthMore) {
  EXPECT_LT(Doubt(0, 1, 0.08).settled_mm(), 0.1);
  EXPECT_NEAR(Doubt(0, 1, 0.13).settled_mm(), 1, 1e-6);
}

}  // namespace
