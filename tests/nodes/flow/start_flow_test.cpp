// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/start_flow.h"

#include <gtest/gtest.h>

#include "nodes/base/scan_points.h"
#include "nodes/flow/relax.h"
#include "nodes/flow/scan_channels.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/scan_frames.h"

namespace {
using namespace face;
using namespace face::flow;

test::ScanLook small() {
  test::ScanLook look;
  look.width = 320;
  look.height = 240;
  return look;
}
}  // namespace

TEST(StartFlow, IsTheTrueFlowOfAHeadThatMovesRigidly) {
  const test::ScanScene scene(small());
  RigidMotion motion;
  const double a = 0.1;
  motion.rotation = {std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a)};
  motion.translation_mm = {5, -3, 8};
  const auto from = scene.frame(scene.points({})), to = scene.frame(scene.points({}, motion));
  DepthScan target = to.scan;
  RigidMotion back;  // what alignment finds: reference from target
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) back.rotation[r * 3 + c] = motion.rotation[c * 3 + r];
  for (std::size_t r = 0; r < 3; ++r) {
    back.translation_mm[r] = 0;
    for (std::size_t k = 0; k < 3; ++k) back.translation_mm[r] -= back.rotation[r * 3 + k] * motion.translation_mm[k];
  }
  target.camera = moved_camera(target.camera, back);
  const FlowField truth = scene.truth(from, to), start = start_flow(from.scan, target, nullptr, nullptr);
  double worst = 0;
  for (std::size_t i = 0; i < truth.valid.size(); ++i)
    if (truth.valid[i])
      worst =
          std::max(worst, std::hypot(static_cast<double>(start.displacement_px[i][0] - truth.displacement_px[i][0]),
                                     static_cast<double>(start.displacement_px[i][1] - truth.displacement_px[i][1])));
  EXPECT_LE(worst, 0.01);  // floats
}

TEST(StartFlow, IsBentByMarkersAndRigidFarFromThem) {
  const test::ScanScene scene(small());
  const DepthScan scan = scene.frame(scene.points({})).scan;
  const Landmarks before{{{"chin", 160, 190, true}, {"lost", 160, 120, true}, {"alone", 150, 100, true}}};
  const Landmarks after{{{"chin", 162, 200, true}, {"lost", 180, 120, false}}};
  const FlowField start = start_flow(scan, scan, &before, &after, {.reach_px = 10});
  const auto at = [&](int x, int y) { return start.displacement_px[static_cast<std::size_t>(y * 320 + x)]; };
  EXPECT_NEAR(at(160, 190)[0], 2, 0.2);
  EXPECT_NEAR(at(160, 190)[1], 10, 0.8);
  EXPECT_NEAR(at(160, 100)[0], 0, 0.01);
  EXPECT_EQ(start.valid[static_cast<std::size_t>(5 * 320 + 5)], 0);  // background
}

TEST(ScanChannels, GiveTheDistanceToAnAxis) {
  const test::ScanScene scene(small());
  const DepthScan scan = scene.frame(scene.points({})).scan;
  const Axis axis{{10, 0, 5}, {0, 1, 0}};
  const FeatureMap map = scan_channels(scan, &axis);
  const ScanRays rays(scan.camera);
  const std::size_t i = 120 * 320 + 150;
  const Vec3f p = rays.point(150, 120, scan.depth_mm[i]);
  EXPECT_NEAR(map.values[i], std::hypot(p[0] - 10, p[2] - 5), 1e-3);
  EXPECT_EQ(map.values[320 * 240 + i], scan.picture.pixels[i]);
  EXPECT_EQ(map.valid[i], 1);
  EXPECT_EQ(map.valid[0], 0);
}

TEST(ScanChannels, RejectDepthOfAnotherSize) {
  DepthScan scan = test::ScanScene(small()).frame(test::ScanScene(small()).points({})).scan;
  scan.depth_mm.pop_back();
  EXPECT_THROW_TEXT(scan_channels(scan, nullptr), "scan has 76799 depths, its picture is 320 x 240 pixels");
}

TEST(Relax, MinimisesTheEnergy) {
  // A chain of three pixels, the ends held at 0 and 6, the middle free: it goes to the weighted mean of its neighbours.
  FlowEnergy energy;
  energy.aa = energy.ab = energy.bb = energy.ra = energy.rb = energy.right = energy.down = Plane(3, 1);
  energy.aa.values = energy.bb.values = {1e4f, 0, 1e4f};
  energy.ra.values = {0, 0, 6e4f};
  energy.rb.values = {1e4f, 0, 1e4f};
  energy.right.values = {1, 2, 0};
  Plane u(3, 1), v(3, 1);
  relax(energy, {0, 0, 0, 2}, 60, 1.5f, u, v);
  EXPECT_NEAR(u.values[1], 4, 1e-2);
  EXPECT_NEAR(v.values[1], 1, 1e-2);
}

TEST(ScanChannels, OfACylinderAreItsRadiusAndGrey) {
  CylinderScan scan;
  scan.picture = {2, 1, 3, {10, 10, 10, 50, 50, 50}};
  scan.radius_mm = {0, 80};
  const FeatureMap map = cylinder_channels(scan);
  EXPECT_EQ(map.valid, (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(map.values[1], 80);
  EXPECT_NEAR(map.values[3], 50, 1e-3);
}
