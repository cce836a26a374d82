// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/phantom/make_camera.h"
#include "nodes/phantom/surface_map.h"
#include "nodes/phantom/truth_flow.h"
#include "nodes/phantom/truth_landmarks.h"
#include "tests/nodes/phantom/head_probe.h"
#include "tests/nodes/phantom/plain_rigs.h"
#include "tests/support/expect_throw_text.h"

namespace face::phantom {
namespace {

Camera camera(double target_z_mm = 0) {
  MakeCameraOptions options;
  options.width_px = 320;
  options.height_px = 240;
  options.target_y_mm = 0;
  options.target_z_mm = target_z_mm;
  return make_camera(options);
}
const SurfaceMapOptions size = {320, 240};

FlowField flow_of(const Rig& rig, const Weights& weights, const RigidMotion& motion, double z_mm = 0) {
  const SurfaceMap reference = surface_map(rig, {}, nullptr, camera(z_mm), size);
  const SurfaceMap target = surface_map(rig, weights, &motion, camera(z_mm), size);
  return truth_flow(rig, reference, target, weights, &motion, camera(z_mm));
}

TEST(TruthFlow, OfAShiftedPlaneIsThatShift) {
  const double px_per_mm = camera().focal_px / 1000;
  const FlowField flow = flow_of(plain::wall(600, 0), {}, plain::moved(7, -3, 0));
  for (std::size_t i = 0; i < flow.valid.size(); ++i) {
    ASSERT_NEAR(flow.displacement_px[i][0], 7 * px_per_mm, 0.002);
    ASSERT_NEAR(flow.displacement_px[i][1], 3 * px_per_mm, 0.002);  // y of pictures is down
    const auto x = static_cast<double>(i % 320), y = static_cast<double>(i / 320);
    const bool inside = x + 7 * px_per_mm < 318.9 && y + 3 * px_per_mm < 238.9;
    const bool outside = x + 7 * px_per_mm > 319.1;
    if (inside || outside) {
      ASSERT_EQ(flow.valid[i], inside ? 1 : 0) << x << ", " << y;
    }
  }
}

TEST(TruthFlow, OfAPlaneThatComesNearerGrowsFromTheMiddle) {
  const FlowField flow = flow_of(plain::wall(600, 0), {}, plain::moved(0, 0, 100));
  for (int y = 0; y < 240; y += 11)
    for (int x = 0; x < 320; x += 11) {
      const auto i = static_cast<std::size_t>(y * 320 + x);
      ASSERT_NEAR(flow.displacement_px[i][0], (x - 159.5) * (1000.0 / 900 - 1), 0.003);
      ASSERT_NEAR(flow.displacement_px[i][1], (y - 119.5) * (1000.0 / 900 - 1), 0.003);
    }
}

TEST(TruthFlow, OfATurningBallHidesWhatTurnsAway) {
  const FlowField flow = flow_of(plain::ball(90), {}, plain::moved(0, 0, 0, 0.5));
  const double px_per_mm = camera().focal_px / 1000;
  const auto valid_at = [&](double x_mm) {
    return flow.valid[static_cast<std::size_t>(120 * 320 + static_cast<int>(159.5 + x_mm * px_per_mm))];
  };
  EXPECT_EQ(valid_at(-60), 1);
  EXPECT_EQ(valid_at(0), 1);
  EXPECT_EQ(valid_at(60), 1);   // asin(60 / 90) + 0.5 = 1.23 rad: still seen
  EXPECT_EQ(valid_at(86), 0);   // 1.77 rad: behind
  EXPECT_EQ(flow.valid[0], 0);  // background
}

TEST(TruthFlow, OfALipFollowsItsShape) {
  const Rig& rig = probe::head();
  Weights open;
  open.values.assign(arkit_count, 0.0f);
  open.values[arkit_index("jawOpen")] = 0.5f;
  const FlowField flow = flow_of(rig, open, {}, 80);
  TruthLandmarksOptions options;
  options.width_px = 320;
  options.height_px = 240;
  const Landmarks before = truth_landmarks(rig, {}, nullptr, camera(80), options);
  const Landmarks after = truth_landmarks(rig, open, nullptr, camera(80), options);
  const Landmark &a = before.points[57], &b = after.points[57];  // below the lower lip
  const auto i = static_cast<std::size_t>(std::lround(a.y_px) * 320 + std::lround(a.x_px));
  EXPECT_EQ(flow.valid[i], 1);
  EXPECT_GT(b.y_px - a.y_px, 4);
  EXPECT_NEAR(flow.displacement_px[i][1], b.y_px - a.y_px, 0.5);  // half a pixel beside the landmark
}

TEST(TruthFlow, RejectsAMapOfAnotherMesh) {
  SurfaceMap map{1, 1, {5}, {{1, 0}}};
  EXPECT_THROW_TEXT(truth_flow(plain::wall(1, 0, 1), map, map, {}, nullptr, camera()),
                    "reference shows triangle 5, but the mesh has 2");
}

TEST(TruthLandmarks, LieWhereTheCameraProjectsTheirVertices) {
  const Rig& rig = probe::head();
  TruthLandmarksOptions options;
  options.width_px = 320;
  options.height_px = 240;
  const RigidMotion motion = plain::moved(5, 0, 0);
  const Landmarks points = truth_landmarks(rig, {}, &motion, camera(80), options);
  ASSERT_EQ(points.points.size(), 68u);
  const Vec3f& nose = rig.neutral.points_mm[rig.landmarks68[30]];
  const double scale = camera(80).focal_px / (1080 - nose[2]);
  EXPECT_EQ(points.points[30].name, "30");
  EXPECT_NEAR(points.points[30].x_px, 159.5 + (nose[0] + 5) * scale, 0.001);
  EXPECT_NEAR(points.points[30].y_px, 119.5 - nose[1] * scale, 0.001);
  EXPECT_TRUE(points.points[30].valid);
}

TEST(TruthLandmarks, AreNotValidWhereTheHeadHidesThem) {
  TruthLandmarksOptions options;
  options.width_px = 320;
  options.height_px = 240;
  const RigidMotion away = plain::moved(0, 0, 0, 1.2);
  const Landmarks turned = truth_landmarks(probe::head(), {}, &away, camera(), options);
  // Turned to its left by 69 degrees the head shows its right side: 37 and 44 are on the outer halves of its upper lids.
  EXPECT_TRUE(turned.points[37].valid);
  EXPECT_FALSE(turned.points[44].valid);
}

TEST(TruthLandmarks, AboutTheLipsAreThreeRigidTwelveOnTheLipAndThreeOnTheJaw) {
  TruthLandmarksOptions options;
  options.set = LandmarkSet::lips18;
  const Landmarks points = truth_landmarks(probe::head(), {}, nullptr, make_camera(), options);
  ASSERT_EQ(points.points.size(), 18u);
  EXPECT_EQ(points.points[0].name, "eye_inner_r");
  EXPECT_EQ(points.points[3].name, "lip_0");
  EXPECT_EQ(points.points[14].name, "lip_11");
  EXPECT_EQ(points.points[17].name, "jaw_l");
  EXPECT_LT(points.points[3].x_px, points.points[9].x_px);  // the corners: the head's right is on the left
}

TEST(TruthLandmarks, NeedARigThatNamesThem) {
  EXPECT_THROW_TEXT(truth_landmarks(plain::wall(1, 0, 1), {}, nullptr, camera()),
                    "the rig names 0 landmarks, expected 68");
}

}  // namespace
}  // namespace face::phantom
