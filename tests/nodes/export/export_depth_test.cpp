// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_depth.h"

#include <gtest/gtest.h>

#include "nodes/export/export_text.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::exports;

DepthScan small_scan() {
  DepthScan scan;
  scan.picture = {3, 2, 1, {10, 20, 30, 40, 50, 60}};
  scan.depth_mm = {0, 900.02f, 901, 0, 3276.75f, 1};
  return scan;
}

}  // namespace

TEST(ExportDepth, WritesSixteenBitsOfGreyAndThePicture) {
  const ExportDepthResult files = export_depth(small_scan());
  EXPECT_EQ(files.depth.suffix(), ".png");
  // PNG, third edition, 11.2.1: width, height, 16 bits per sample, grey.
  EXPECT_EQ(files.depth.bytes().substr(12, 14), std::string("IHDR\0\0\0\3\0\0\0\2\x10\0", 14));
  EXPECT_EQ(files.picture.bytes().substr(12, 14), std::string("IHDR\0\0\0\3\0\0\0\2\x08\0", 14));
  EXPECT_EQ(files.depth.bytes(), export_depth(small_scan()).depth.bytes());
}

TEST(ExportDepth, RejectsADepthThatSixteenBitsCannotHold) {
  DepthScan scan = small_scan();
  scan.depth_mm[1] = 4000;
  EXPECT_THROW_TEXT(export_depth(scan),
                    "pixel 1 has a depth of 4000 mm, which is 80000 units of 0.05 mm, expected at most 65535");
}

TEST(ExportScanCamera, WritesIntrinsicsPoseAndUnit) {
  Camera camera;
  camera.focal_px = 525;
  const engine::File file = export_scan_camera(camera, {.width_px = 64, .height_px = 48});
  EXPECT_EQ(file.suffix(), ".json");
  EXPECT_EQ(file.bytes().substr(0, 52), "{\n  \"fx\": 525.0,\n  \"fy\": 525.0,\n  \"cx\": 319.5,\n  \"cy");
  EXPECT_NE(file.bytes().find("\"depth_unit_mm\": 0.05,\n"), std::string::npos);
}

TEST(ExportText, WritesTheTextAsItIs) {
  EXPECT_EQ(export_text("frame 3 is missing\n").bytes(), "frame 3 is missing\n");
  EXPECT_EQ(export_text("").suffix(), ".txt");
}
