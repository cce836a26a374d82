// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/cylinder_curvature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_throw_text.h"

namespace face::flow {
namespace {

constexpr int rows = 200, columns = 256;

// A scan of r(h, phi), one row a millimetre.
template <class Radius>
CylinderScan scan_of(Radius radius_mm) {
  CylinderScan scan;
  scan.step_mm = 1;
  scan.top_mm = 0.5 * (rows - 1);
  scan.phi_step_rad = static_cast<float>(2 * M_PI / columns);
  scan.picture = {columns, rows, 3, std::vector<std::uint8_t>(3 * rows * columns, 100)};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      scan.radius_mm.push_back(static_cast<float>(
          radius_mm(0.5 * (rows - 1) - y, (x - 0.5 * (columns - 1)) * static_cast<double>(scan.phi_step_rad))));
  return scan;
}

std::size_t pixel(int y, int x) { return static_cast<std::size_t>(y * columns + x); }

TEST(CylinderCurvature, OfABallIsOneOverItsRadius) {
  // Seen from its middle: 80 mm. On its upper half the surface is oblique to the rows and columns.
  const CylinderCurvature found =
      cylinder_curvature(scan_of([](double h, double) { return std::sqrt(std::max(80.0 * 80 - h * h, 0.0)); }), 2);
  for (const int y : {rows / 2, rows / 2 - 30, rows / 2 + 40})
    EXPECT_NEAR(found.times_scale[pixel(y, 100)], 2.0 / 80, 1e-3) << y;
}

TEST(CylinderCurvature, OfATubeIsHalfOfThatAndOfAFlatWallNone) {
  const CylinderCurvature tube = cylinder_curvature(scan_of([](double, double) { return 50.0; }), 4);
  EXPECT_NEAR(tube.times_scale[pixel(100, 30)], 4 * 0.5 / 50, 1e-4);
  // The plane 60 mm in front of the axis, up to 60 degrees to either side.
  const CylinderCurvature wall = cylinder_curvature(
      scan_of([](double, double phi) { return std::abs(phi) < 1.05 ? 60 / std::cos(phi) : 0.0; }), 4);
  for (const int x : {columns / 2, columns / 2 + 20, columns / 2 - 20})
    EXPECT_NEAR(wall.times_scale[pixel(100, x)], 0, 4e-3) << x;
}

TEST(CylinderCurvature, PeaksAtTheTipOfANoseHoweverLargeTheHead) {
  for (const double head_mm : {70.0, 100.0}) {
    const CylinderCurvature found = cylinder_curvature(scan_of([&](double h, double phi) {
                                                         const double x = head_mm * phi;
                                                         return head_mm + 20 * std::exp(-(h * h + x * x) / 200);
                                                       }),
                                                       3);
    std::size_t most = 0;
    for (std::size_t i = 0; i < found.times_scale.size(); ++i)
      if (found.times_scale[i] > found.times_scale[most]) most = i;
    EXPECT_NEAR(static_cast<double>(most / columns), 0.5 * (rows - 1), 1) << head_mm;
    EXPECT_NEAR(static_cast<double>(most % columns), 0.5 * (columns - 1), 1) << head_mm;
  }
}

TEST(CylinderCurvature, IsNotKnownWhereTooLittleIsMeasured) {
  CylinderScan scan = scan_of([](double h, double) { return h > 0 ? 60.0 : 0.0; });
  const CylinderCurvature found = cylinder_curvature(scan, 3);
  EXPECT_EQ(found.known[pixel(20, 20)], 1);
  EXPECT_EQ(found.known[pixel(150, 20)], 0);
  EXPECT_FLOAT_EQ(found.times_scale[pixel(150, 20)], 0);
  EXPECT_EQ(found.known[pixel(0, 20)], 0);  // no row above
}

TEST(CylinderCurvature, RejectsWhatIsNoScanAndNoScale) {
  CylinderScan scan = scan_of([](double, double) { return 60.0; });
  EXPECT_THROW_TEXT(cylinder_curvature(scan, 0), "scale_mm is 0, expected more than 0");
  scan.step_mm = 0;
  EXPECT_THROW_TEXT(cylinder_curvature(scan, 3), "scan has steps of 0 mm and 0.0245437 rad, expected more than 0");
  scan.radius_mm.pop_back();
  EXPECT_THROW_TEXT(cylinder_curvature(scan, 3), "scan has 51199 radii, its picture is 256 x 200 pixels");
}

}  // namespace
}  // namespace face::flow
