// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/cylinder_colours.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

namespace face::flow {
namespace {

// Five columns of 45 degrees, one row: radius 81 ... 85, red 10 ... 50, green 1 more, blue 2 more.
CylinderScan ring() {
  CylinderScan scan;
  scan.phi_step_rad = 0.785398f;
  scan.picture = {5, 1, 3, {}};
  for (int x = 0; x < 5; ++x) {
    scan.radius_mm.push_back(81.0f + static_cast<float>(x));
    for (int c = 0; c < 3; ++c) scan.picture.pixels.push_back(static_cast<std::uint8_t>(10 * (x + 1) + c));
  }
  return scan;
}

// 40 rows of 2 mm, 64 columns around.
CylinderScan tube(float radius_mm) {
  CylinderScan scan;
  scan.step_mm = 2;
  scan.phi_step_rad = 6.2831853f / 64;
  scan.picture = {64, 40, 3, std::vector<std::uint8_t>(3 * 40 * 64, 128)};
  scan.radius_mm.assign(40 * 64, radius_mm);
  return scan;
}

TEST(CylinderColours, AreRadiusAndColourSideBySide) {
  const FeatureMap map = cylinder_colours(ring());
  EXPECT_EQ(map.names, (std::vector<std::string>{"radius", "red", "green", "blue"}));
  EXPECT_EQ(map.values,
            (std::vector<float>{81, 82, 83, 84, 85, 10, 20, 30, 40, 50, 11, 21, 31, 41, 51, 12, 22, 32, 42, 52}));
}

TEST(CylinderColours, CountOnlyWhereMeasuredAndInFront) {
  CylinderScan scan = ring();
  scan.radius_mm[3] = 0;
  EXPECT_EQ(cylinder_colours(scan, {.half_angle_deg = 180}).valid, (std::vector<std::uint8_t>{1, 1, 1, 0, 1}));
  EXPECT_EQ(cylinder_colours(scan, {.half_angle_deg = 60}).valid, (std::vector<std::uint8_t>{0, 1, 1, 0, 0}));
}

TEST(CylinderColours, AddCurvatureWhereItIsAskedFor) {
  CylinderScan scan = tube(60);
  scan.radius_mm[20 * 64 + 10] = 0;
  const FeatureMap map = cylinder_colours(scan, {.half_angle_deg = 180, .curvature_scale_mm = 3});
  EXPECT_EQ(map.names.back(), "curvature");
  ASSERT_EQ(map.values.size(), 5u * 40 * 64);
  EXPECT_NEAR(map.values[4 * 40 * 64 + 20 * 64 + 32], 3 * 0.5 / 60, 1e-3);
  EXPECT_EQ(map.valid[20 * 64 + 10], 0);
  EXPECT_EQ(map.valid[20 * 64 + 11], 1);
}

TEST(CylinderColours, RejectsScansWhosePartsDoNotFit) {
  CylinderScan scan = ring();
  scan.radius_mm.pop_back();
  EXPECT_THROW_TEXT(cylinder_colours(scan), "scan has 4 radii, its picture is 5 x 1 pixels");
}

}  // namespace
}  // namespace face::flow
