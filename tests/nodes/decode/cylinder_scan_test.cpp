// SPDX-License-Identifier: Apache-2.0
// The way there and back is in tests/nodes/export/export_cylinder_test.cpp.
#include "nodes/decode/cylinder_scan.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/nodes/decode/temporary.h"
#include "tests/support/expect_throw_text.h"

namespace face::decode {
namespace {

class CylinderScanFiles : public testing::Test {
 protected:
  CylinderScanFiles() {
    cv::Mat radius(2, 4, CV_16U, cv::Scalar(850)), colour(2, 4, CV_8UC3, cv::Scalar(30, 20, 10));
    radius.at<std::uint16_t>(1, 2) = 0;
    cv::imwrite(temporary_.path("radius.png"), radius);
    cv::imwrite(temporary_.path("colour.png"), colour);
    cv::imwrite(temporary_.path("narrow.png"), colour.colRange(0, 3));
  }
  CylinderScan read(const std::string& header, const std::string& colour = "colour.png") const {
    return cylinder_scan(engine::File::at(temporary_.write("scan.json", header)),
                         engine::File::at(temporary_.path("radius.png")), engine::File::at(temporary_.path(colour)));
  }
  test::Temporary temporary_;
  const std::string header_ =
      R"({"axis_origin_mm": [0, 0, 15], "axis_direction": [0, 1, 0], "top_mm": 30, "step_mm": 2, "radius_unit_mm": 0.1})";
};

TEST_F(CylinderScanFiles, AreAHeaderAndTwoPictures) {
  const CylinderScan scan = read(header_);
  EXPECT_EQ(scan.axis.origin_mm, (Vec3f{0, 0, 15}));
  EXPECT_EQ(scan.top_mm, 30);
  EXPECT_NEAR(scan.phi_step_rad, 1.5707963f, 1e-6f);  // a full turn in four columns
  ASSERT_EQ(scan.radius_mm.size(), 8u);
  EXPECT_NEAR(scan.radius_mm[0], 85, 1e-4f);
  EXPECT_EQ(scan.radius_mm[6], 0);  // nothing measured
  EXPECT_EQ(scan.picture.pixels[0], 10);
  EXPECT_EQ(scan.picture.pixels[2], 30);
}

TEST_F(CylinderScanFiles, SayWhereTheyAreWrong) {
  EXPECT_THROW_TEXT(read(R"({"axis_origin_mm": [0, 0, 15], "axis_direction": [0, 1, 0], "top_mm": 30, "step_mm": 0})"),
                    "scan.json at /step_mm: found 0, expected more than 0");
  EXPECT_THROW_TEXT(read(header_, "narrow.png"), "narrow.png: is 3 x 2 pixels, the radii of radius.png are 4 x 2");
}

}  // namespace
}  // namespace face::decode
