// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/draw_scan.h"

#include <gtest/gtest.h>

#include "nodes/phantom/make_lighting.h"
#include "nodes/phantom/number_persons.h"
#include "tests/support/expect_throw_text.h"

namespace face::phantom {
namespace {

TEST(DrawScan, ShowsTheSurfaceBesideThePictureAndHolesInRed) {
  DepthScan scan;
  scan.picture = {8, 6, 1, std::vector<std::uint8_t>(48, 77)};
  scan.depth_mm.assign(48, 500);
  scan.depth_mm[0] = 0;
  const Image image = draw_scan(scan);
  EXPECT_EQ(image.width, 16);
  EXPECT_EQ(image.height, 6);
  EXPECT_GT(image.pixels[0], 2 * image.pixels[1]);          // a hole
  EXPECT_EQ(image.pixels[3 * 5], image.pixels[3 * 5 + 1]);  // a surface
  EXPECT_GT(image.pixels[3 * 5], 150);                      // that faces the scanner
  EXPECT_EQ(image.pixels[3 * 8], 77);
  // A surface that turns away from the light is darker.
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 8; ++x) scan.depth_mm[static_cast<std::size_t>(8 * y + x)] = 500.0f + 3 * static_cast<float>(x);
  EXPECT_NE(draw_scan(scan).pixels[3 * (16 * 3 + 4)], image.pixels[3 * (16 * 3 + 4)]);
  scan.depth_mm.pop_back();
  EXPECT_THROW_TEXT(draw_scan(scan), "the scan has 47 values, but its picture is 8 x 6");
}

TEST(DrawLaserScan, LightsATubeEvenlyAllAround) {
  CylinderScan scan;
  scan.phi_step_rad = 0.7853982f;
  scan.picture = {8, 4, 3, std::vector<std::uint8_t>(96, 50)};
  scan.radius_mm.assign(32, 80);
  const Image image = draw_laser_scan(scan);
  EXPECT_EQ(image.width, 16);
  for (int x = 1; x < 7; ++x)
    EXPECT_NEAR(image.pixels[static_cast<std::size_t>(3 * (16 + x))], image.pixels[3 * 17], 1);
}

TEST(MakeLighting, TurnsAnglesIntoADirection) {
  MakeLightingOptions options;
  options.yaw_deg = 90;
  options.pitch_deg = 0;
  EXPECT_NEAR(make_lighting(options).towards_light[0], 1, 1e-6);  // the head's left
  options.pitch_deg = 90;
  EXPECT_NEAR(make_lighting(options).towards_light[1], 1, 1e-6);
  options.gain_green = 1.5;
  options.contrast = 0.25;
  EXPECT_EQ(make_lighting(options).gain, (Vec3f{1, 1.5f, 1}));
  EXPECT_EQ(make_lighting(options).contrast, 0.25f);
}

TEST(NumberPersons, CountsFromOne) {
  std::vector<std::string> ids;
  engine::SeqWriter<std::string> writer([&](const std::string& id, const std::string& text) {
    EXPECT_EQ(id, text);
    ids.push_back(text);
  });
  NumberPersonsOptions options;
  options.count = 3;
  number_persons(writer, options);
  EXPECT_EQ(ids, (std::vector<std::string>{"1", "2", "3"}));
}

}  // namespace
}  // namespace face::phantom
