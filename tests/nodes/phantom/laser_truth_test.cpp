// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/laser_truth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/pose.h"
#include "nodes/base/scan_points.h"
#include "nodes/phantom/laser_scan.h"
#include "tests/nodes/phantom/head_probe.h"
#include "tests/support/expect_throw_text.h"

namespace face::phantom {
namespace {

Weights open_mouth() {
  Weights weights{std::vector<float>(arkit_count, 0.0f)};
  weights.values[arkit_index("jawOpen")] = 0.5f;
  return weights;
}

LaserScanResult scan_of(const Weights& weights) {
  LaserScanOptions options;
  options.rows = options.columns = 128;
  options.step_mm = 2.4;
  options.noise_mm = options.dropouts = options.missing_hair = 0;
  return laser_scan(probe::head(), weights, nullptr, nullptr, options);
}

TEST(LaserLandmarks, AreWhereTheirVerticesAreInTheScan) {
  const Weights weights = open_mouth();
  const CylinderScan scan = scan_of(weights).scan;
  const Landmarks marks = laser_landmarks(probe::head(), weights, scan);
  ASSERT_EQ(marks.points.size(), 68u);
  EXPECT_EQ(marks.points[8].name, "08");
  const std::vector<Vec3f> points = pose_points(probe::head(), weights);
  for (const std::size_t i : {8u, 30u, 36u, 48u}) {
    const Landmark& mark = marks.points[i];
    CylinderPlace place;
    place.h_mm = scan.top_mm - mark.y_px * scan.step_mm;
    place.phi_rad = (mark.x_px - 0.5 * (scan.picture.width - 1)) * scan.phi_step_rad;
    place.radius_mm = radius_about(scan.axis, points[probe::head().landmarks68[i]]);
    const Vec3f back = cylinder_point(scan.axis, place);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], points[probe::head().landmarks68[i]][k], 1e-3) << i;
    EXPECT_TRUE(mark.valid);
  }
  Rig bare = probe::head();
  bare.landmarks68.clear();
  EXPECT_THROW_TEXT(laser_landmarks(bare, weights, scan), "the rig names 0 landmarks, expected 68");
}

// A surface of three vertices at pixels of the scan.
MorphableModel three_pixels(const CylinderScan& scan) {
  MorphableModel surface;
  const auto at = [&](int x, int y) {
    surface.mean.points_mm.push_back({0, 0, 0});
    surface.mean.uvs.push_back({(static_cast<float>(x) + 0.5f) / static_cast<float>(scan.picture.width),
                                1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(scan.picture.height)});
  };
  at(64, 60), at(70, 64), at(58, 70);
  surface.mean.corners = {0, 1, 2};
  surface.mean.polygon_starts = {0, 3};
  return surface;
}

TEST(LaserTruth, OfTheScannedFaceIsTheScan) {
  const Weights weights = open_mouth();
  const LaserScanResult taken = scan_of(weights);
  const MorphableModel surface = three_pixels(taken.scan);
  const MeshPoints truth = laser_truth(probe::head(), weights, taken.truth, surface);
  ASSERT_EQ(truth.points_mm.size(), 3u);
  const int columns[] = {64, 70, 58}, rows[] = {60, 64, 70};
  for (std::size_t v = 0; v < 3; ++v) {
    const CylinderPlace place = cylinder_place(taken.scan.axis, truth.points_mm[v]);
    EXPECT_NEAR(place.phi_rad / taken.scan.phi_step_rad + 63.5, columns[v], 0.02);
    EXPECT_NEAR((taken.scan.top_mm - place.h_mm) / taken.scan.step_mm, rows[v], 0.02);
  }
  // Of another face it is where the same skin went: with the jaw shut nothing is lower.
  const MeshPoints shut = laser_truth(probe::head(), {std::vector<float>(arkit_count, 0.0f)}, taken.truth, surface);
  for (std::size_t v = 0; v < 3; ++v) EXPECT_GE(shut.points_mm[v][1], truth.points_mm[v][1] - 0.5f);
}

TEST(LaserTruth, RejectsASurfaceThatIsNotOfTheScan) {
  const Weights weights = open_mouth();
  const LaserScanResult taken = scan_of(weights);
  MorphableModel surface = three_pixels(taken.scan);
  surface.mean.uvs.pop_back();
  EXPECT_THROW_TEXT(laser_truth(probe::head(), weights, taken.truth, surface),
                    "surface has 2 uvs, expected one for each of its 3 vertices");
}

}  // namespace
}  // namespace face::phantom
