// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_cylinder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "nodes/decode/cylinder_scan.h"
#include "tests/support/expect_throw_text.h"

namespace face::exports {
namespace {

CylinderScan small_scan() {
  CylinderScan scan;
  scan.axis.origin_mm = {1, 2, 15};
  scan.top_mm = 30;
  scan.step_mm = 2;
  scan.phi_step_rad = 0.5f;
  scan.picture = {12, 3, 3, {}};
  for (int i = 0; i < 36; ++i) {
    scan.radius_mm.push_back(i % 7 == 0 ? 0.0f : 80.0f + 0.37f * static_cast<float>(i));
    for (int c = 0; c < 3; ++c) scan.picture.pixels.push_back(static_cast<std::uint8_t>(7 * i % 250 + c));
  }
  return scan;
}

class ExportCylinder : public testing::Test {
 protected:
  ExportCylinder()
      : folder_(std::filesystem::temp_directory_path() /
                ("export_cylinder_" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~ExportCylinder() override { std::filesystem::remove_all(folder_); }
  engine::File put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return engine::File::at((folder_ / name).string());
  }
  CylinderScan read(const ExportCylinderResult& written, const std::string& header) const {
    return decode::cylinder_scan(put("scan.json", header), put("radius.png", written.radius.bytes()),
                                 put("colour.png", written.colour.bytes()));
  }
  std::filesystem::path folder_;
};

TEST_F(ExportCylinder, IsReadBackAsItWas) {
  const CylinderScan scan = small_scan();
  const ExportCylinderResult written = export_cylinder(scan);
  const CylinderScan back = read(written, written.header.bytes());
  EXPECT_EQ(back.axis.origin_mm, scan.axis.origin_mm);
  EXPECT_EQ(back.top_mm, scan.top_mm);
  EXPECT_NEAR(back.phi_step_rad, scan.phi_step_rad, 1e-6f);
  EXPECT_EQ(back.picture.pixels, scan.picture.pixels);
  ASSERT_EQ(back.radius_mm.size(), scan.radius_mm.size());
  for (std::size_t i = 0; i < scan.radius_mm.size(); ++i) {
    EXPECT_NEAR(back.radius_mm[i], scan.radius_mm[i], 0.0026f);  // half a unit
    EXPECT_EQ(back.radius_mm[i] > 0, scan.radius_mm[i] > 0);
  }
}

TEST_F(ExportCylinder, TakesAFullTurnWhereTheHeaderDoesNotSay) {
  const ExportCylinderResult written = export_cylinder(small_scan());
  const CylinderScan back = read(written, R"({"axis_origin_mm": [0, 0, 0], "axis_direction": [0, 1, 0], "top_mm": 30,
                                              "step_mm": 2, "radius_unit_mm": 0.005})");
  EXPECT_NEAR(back.phi_step_rad, 2 * 3.14159265f / 12, 1e-6f);
}

TEST_F(ExportCylinder, SaysWhereAHeaderIsWrong) {
  const ExportCylinderResult written = export_cylinder(small_scan());
  EXPECT_THROW_TEXT(read(written, R"({"axis_origin_mm": [0, 0, 0], "axis_direction": [0, 2, 0]})"),
                    "scan.json at /axis_direction: found a length of 2, expected 1");
  EXPECT_THROW_TEXT(read(written, R"({"axis_origin_mm": [0, 0], "axis_direction": [0, 1, 0]})"),
                    "scan.json at /axis_origin_mm: found [0,0], expected [x, y, z]");
}

TEST_F(ExportCylinder, WantsPicturesOfOneSize) {
  ExportCylinderResult written = export_cylinder(small_scan());
  CylinderScan other = small_scan();
  other.picture.width = 6;
  other.picture.height = 6;
  written.colour = export_cylinder(other).colour;
  EXPECT_THROW_TEXT(read(written, written.header.bytes()),
                    "colour.png: is 6 x 6 pixels, the radii of radius.png are 12 x 3");
}

TEST_F(ExportCylinder, DoesNotWriteARadiusThatHasNoUnit) {
  CylinderScan scan = small_scan();
  scan.radius_mm[5] = 400;
  EXPECT_THROW_TEXT(export_cylinder(scan), "a radius is 400 mm, expected at most 65535 units of 0.005 mm");
}

}  // namespace
}  // namespace face::exports
