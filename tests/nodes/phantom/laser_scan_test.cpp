// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/laser_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "nodes/phantom/read_configurations.h"
#include "nodes/render/triangulate.h"
#include "tests/nodes/phantom/head_probe.h"
#include "tests/nodes/phantom/plain_rigs.h"
#include "tests/support/expect_throw_text.h"

namespace face::phantom {
namespace {

// All faults off, about the y axis.
LaserScanOptions clean() {
  LaserScanOptions options;
  options.rows = options.columns = 256;
  options.top_mm = 100;
  options.step_mm = 0.8;
  options.axis_z_mm = 0;
  options.bathing_cap = false;
  options.missing_hair = options.dropouts = options.noise_mm = options.radius_step_mm = options.shading = 0;
  options.colour_noise = 0;
  options.max_angle_deg = 90;
  return options;
}

float radius_at(const CylinderScan& scan, int row, int column) {
  return scan.radius_mm[static_cast<std::size_t>(row * scan.picture.width + column)];
}
int measured(const CylinderScan& scan) {
  return static_cast<int>(
      std::count_if(scan.radius_mm.begin(), scan.radius_mm.end(), [](float radius) { return radius > 0; }));
}

TEST(LaserScan, OfATubeReturnsItsRadiusWithoutASeam) {
  const CylinderScan scan = laser_scan(plain::tube(80, 300), {}, nullptr, nullptr, clean()).scan;
  EXPECT_EQ(measured(scan), 256 * 256);
  for (const float radius : scan.radius_mm) ASSERT_NEAR(radius, 80, 0.001);  // chords of 0.5 degrees: 0.0008 mm
}

TEST(LaserScan, OfABallReturnsItsProfile) {
  LaserScanOptions options = clean();
  const CylinderScan scan = laser_scan(plain::ball(90), {}, nullptr, nullptr, options).scan;
  for (int row = 20; row < 240; row += 10)
    for (int column = 0; column < 256; column += 5) {
      const double h = options.top_mm - row * options.step_mm;
      if (std::abs(h) > 85) continue;
      ASSERT_NEAR(radius_at(scan, row, column), std::sqrt(90.0 * 90 - h * h), 0.01) << row << ", " << column;
    }
  EXPECT_EQ(radius_at(scan, 0, 100), 0);  // above it
}

TEST(LaserScan, AboutAnAxisBesideTheMiddleReturnsTheDistanceToIt) {
  LaserScanOptions options = clean();
  options.axis_x_mm = 10;
  options.axis_z_mm = -20;
  const CylinderScan scan = laser_scan(plain::tube(80, 300), {}, nullptr, nullptr, options).scan;
  for (int column = 0; column < 256; ++column) {
    const double phi = (column - 127.5) * 2 * std::numbers::pi / 256, dx = std::sin(phi), dz = std::cos(phi);
    const double along = 10 * dx - 20 * dz;
    const double expected = -along + std::sqrt(along * along - (100 + 400) + 6400);
    ASSERT_NEAR(radius_at(scan, 128, column), expected, 0.001);
  }
  EXPECT_EQ(scan.axis.origin_mm, (Vec3f{10, 0, -20}));
}

TEST(LaserScan, KeepsTheOutermostSurface) {
  Rig rig = plain::tube(60, 300);
  const Rig outer = plain::tube(80, 300);
  const auto first = static_cast<std::uint32_t>(rig.neutral.points_mm.size());
  const auto corners = static_cast<std::uint32_t>(rig.neutral.corners.size());
  for (const Vec3f& p : outer.neutral.points_mm) rig.neutral.points_mm.push_back(p);
  for (const Vec3f& c : outer.neutral.colors_srgb) rig.neutral.colors_srgb.push_back(c);
  for (const std::uint32_t c : outer.neutral.corners) rig.neutral.corners.push_back(first + c);
  for (std::size_t i = 1; i < outer.neutral.polygon_starts.size(); ++i)
    rig.neutral.polygon_starts.push_back(corners + outer.neutral.polygon_starts[i]);
  for (const float radius : laser_scan(rig, {}, nullptr, nullptr, clean()).scan.radius_mm)
    ASSERT_NEAR(radius, 80, 0.001);
}

TEST(LaserScan, HasNoiseDropoutsAndStepsAsGiven) {
  LaserScanOptions options = clean();
  options.noise_mm = 0.3;
  options.dropouts = 0.05;
  const Rig tube = plain::tube(80, 300);
  const CylinderScan noisy = laser_scan(tube, {}, nullptr, nullptr, options).scan;
  std::vector<double> errors;
  for (const float radius : noisy.radius_mm)
    if (radius > 0) errors.push_back(radius - 80);
  const double count = 65536;
  EXPECT_NEAR(1 - static_cast<double>(errors.size()) / count, 0.05, 5 * std::sqrt(0.05 * 0.95 / count));
  EXPECT_NEAR(plain::spread_of(errors).mean, 0, 5 * 0.3 / std::sqrt(count) + 0.0008);
  EXPECT_NEAR(plain::spread_of(errors).deviation, 0.3, 5 * 0.3 / std::sqrt(2 * count));
  options = clean();
  options.radius_step_mm = 0.25;
  for (const float radius : laser_scan(plain::ball(90), {}, nullptr, nullptr, options).scan.radius_mm)
    ASSERT_EQ(radius * 4, std::round(radius * 4));
}

TEST(LaserScan, LosesSteepPlaces) {
  LaserScanOptions options = clean();
  options.max_angle_deg = 60;
  const CylinderScan scan = laser_scan(plain::ball(90), {}, nullptr, nullptr, options).scan;
  double highest = 0;
  for (int row = 0; row < 128; ++row)
    if (radius_at(scan, row, 128) > 0) highest = std::max(highest, options.top_mm - row * options.step_mm);
  EXPECT_NEAR(highest, 90 * std::sin(std::numbers::pi / 3), options.step_mm);
}

TEST(LaserScan, WearsACapAndWithoutItMissesHair) {
  const Rig& rig = probe::head();
  const std::vector<std::uint16_t> parts = render::triangulate(rig.neutral, false).parts;
  const auto count = [&](const LaserScanOptions& options) {
    const LaserScanResult result = laser_scan(rig, {}, nullptr, nullptr, options);
    std::pair<int, int> hair = {0, 0};  // seen, measured
    for (std::size_t i = 0; i < parts.size() && i < result.truth.triangle.size(); ++i)
      if (result.truth.triangle[i] >= 0 &&
          rig.neutral.parts[parts[static_cast<std::size_t>(result.truth.triangle[i])]].name == "hair") {
        ++hair.first;
        hair.second += result.scan.radius_mm[i] > 0 ? 1 : 0;
      }
    return hair;
  };
  LaserScanOptions options = clean();
  options.top_mm = 160;
  options.step_mm = 1.2;
  EXPECT_EQ(count(options).first, count(options).second);
  EXPECT_GT(count(options).first, 5000);
  options.missing_hair = 0.7;
  EXPECT_NEAR(count(options).second, 0.3 * count(options).first, 0.08 * count(options).first);  // in patches
  options.bathing_cap = true;
  EXPECT_EQ(count(options).first, 0);
}

TEST(LaserScan, IsTheSameForASeedAndOtherwiseNot) {
  LaserScanOptions options = clean();
  options.noise_mm = 0.1;
  const Rig tube = plain::tube(80, 300);
  const std::string one = "1", two = "2";
  const auto radii = [&](const std::string& id) { return laser_scan(tube, {}, nullptr, &id, options).scan.radius_mm; };
  EXPECT_EQ(radii(one), radii(one));
  EXPECT_NE(radii(one), radii(two));
}

TEST(LaserScan, RejectsAnAxisFarAway) {
  LaserScanOptions options = clean();
  options.axis_z_mm = 2000;
  EXPECT_THROW_TEXT(laser_scan(plain::wall(0, 0, 1), {}, nullptr, nullptr, options),
                    "vertex 0 is 2000 mm from the axis, expected less than 1000");
}

class Configurations : public testing::Test {
 protected:
  std::vector<std::pair<std::string, Weights>> read(const std::string& text) {
    std::ofstream(path_) << text;
    std::vector<std::pair<std::string, Weights>> faces;
    engine::SeqWriter<Weights> writer(
        [&](const std::string& id, Weights weights) { faces.emplace_back(id, std::move(weights)); });
    read_configurations(engine::File::at(path_), writer);
    return faces;
  }
  std::string path_ = testing::TempDir() + "faces.json";
};

TEST_F(Configurations, AreReadByArkitNameOnOneSideOrBoth) {
  const auto faces = read(R"({"b": {"jawOpen": 0.5}, "a": {"mouthSmile": 0.25}})");
  ASSERT_EQ(faces.size(), 2u);
  EXPECT_EQ(faces[0].first, "b");
  EXPECT_EQ(faces[0].second.values[arkit_index("jawOpen")], 0.5f);
  EXPECT_EQ(faces[1].second.values[arkit_index("mouthSmileLeft")], 0.25f);
  EXPECT_EQ(faces[1].second.values[arkit_index("mouthSmileRight")], 0.25f);
}

TEST_F(Configurations, OfTheGraphsAre35FacesAndTwoWithTeeth) {
  std::vector<std::string> names;
  engine::SeqWriter<Weights> writer([&](const std::string& id, const Weights&) { names.push_back(id); });
  read_configurations(engine::File::at(std::string(FACEGRAPH_SOURCE_DIR) + "/graphs/phantom/mouth_configurations.json"),
                      writer);
  EXPECT_EQ(names.size(), 37u);
  EXPECT_EQ(std::count_if(names.begin(), names.end(), [](const auto& n) { return n.starts_with("viseme_"); }), 17);
  EXPECT_EQ(std::count_if(names.begin(), names.end(), [](const auto& n) { return n.starts_with("teeth_"); }), 2);
}

TEST_F(Configurations, RejectUnknownShapesAndWeights) {
  EXPECT_THROW_TEXT(read(R"({"a": {"jawOpn": 0.5}})"), "faces.json: a: no ARKit shape is called \"jawOpn\"");
  EXPECT_THROW_TEXT(read(R"({"a": {"jawOpen": 2}})"), "faces.json: a: jawOpen is 2, expected a number from 0 to 1");
  EXPECT_THROW_TEXT(read("[]"), "faces.json: expected an object of faces by name");
}

}  // namespace
}  // namespace face::phantom
