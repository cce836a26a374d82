// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/pattern_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/decode/structured_light.h"
#include "nodes/phantom/make_camera.h"
#include "nodes/phantom/scan_frame.h"
#include "tests/nodes/phantom/head_probe.h"
#include "tests/nodes/phantom/plain_rigs.h"

namespace face::phantom {
namespace {

struct Scanner {
  Camera camera, projector;
};
Scanner scanner(double target_z_mm = 0) {
  MakeCameraOptions options;
  options.width_px = 320;
  options.height_px = 240;
  options.target_y_mm = 0;
  options.target_z_mm = target_z_mm;
  const Camera camera = make_camera(options);
  options.width_px = 1024;
  options.height_px = 768;
  options.yaw_deg = -17;
  options.field_of_view_deg = 18;
  return {camera, make_camera(options)};
}

PatternImagesOptions quiet() {
  PatternImagesOptions options;
  options.width_px = 320;
  options.height_px = 240;
  options.exposure_step = options.grey_noise = 0;
  return options;
}

engine::Seq<Image> images_of(const Rig& rig, const PatternImagesOptions& options, const Scanner& at = scanner(),
                             const engine::Window<Weights>& faces = plain::still_face(),
                             const engine::Window<RigidMotion>& heads = plain::still_head()) {
  std::vector<Image> images;
  engine::SeqWriter<Image> writer([&](const std::string&, Image image) { images.push_back(std::move(image)); });
  pattern_images(rig, faces, heads, at.camera, at.projector, nullptr, nullptr, writer, options);
  return engine::Seq<Image>(std::move(images));
}

std::vector<double> differences(const DepthScan& a, const DepthScan& b) {
  std::vector<double> found;
  for (std::size_t i = 0; i < a.depth_mm.size(); ++i)
    if (a.depth_mm[i] > 0 && b.depth_mm[i] > 0) found.push_back(double{a.depth_mm[i]} - b.depth_mm[i]);
  return found;
}

ScanFrameOptions exact() {
  ScanFrameOptions options;
  options.width_px = 320;
  options.height_px = 240;
  options.noise_mm = options.dropouts = options.min_signal = options.depth_step_mm = options.exposure_step = 0;
  options.grey_noise = 0;
  options.max_angle_deg = 90;
  return options;
}

TEST(PatternImages, OfAPlaneDecodeToItsDepth) {
  const Scanner at = scanner();
  for (const double z_mm : {-120.0, 0.0, 35.0, 150.0}) {
    const DepthScan scan =
        decode::structured_light(images_of(plain::wall(420, z_mm), quiet()), at.camera, at.projector);
    std::vector<double> errors;
    for (const float depth : scan.depth_mm)
      if (depth > 0) errors.push_back(depth - (1000 - z_mm));
    EXPECT_GT(errors.size(), 70000u) << z_mm;
    // 8 bits: rounding of 1/12 level and an amplitude of 34 give 0.0035 periods of 32 px, about 0.14 mm.
    EXPECT_NEAR(plain::spread_of(errors).mean, 0, 0.02) << z_mm;
    EXPECT_LT(plain::spread_of(errors).deviation, 0.2) << z_mm;
  }
}

TEST(PatternImages, OfABallDecodeToItsRadius) {
  const Scanner at = scanner();
  const DepthScan scan = decode::structured_light(images_of(plain::ball(90), quiet()), at.camera, at.projector);
  std::vector<double> errors;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const double depth = scan.depth_mm[static_cast<std::size_t>(y * 320 + x)];
      if (depth == 0) continue;
      const double px = (x - 159.5) * depth / at.camera.focal_px, py = (119.5 - y) * depth / at.camera.focal_px;
      if (std::hypot(px, py) < 75) errors.push_back(std::hypot(px, py, 1000 - depth) - 90);
    }
  EXPECT_GT(errors.size(), 8000u);
  EXPECT_NEAR(plain::spread_of(errors).mean, 0, 0.05);
  EXPECT_LT(plain::spread_of(errors).deviation, 0.25);
}

TEST(PatternImages, OfAHeadDecodeToTheScanWithItsShadowHoles) {
  const Scanner at = scanner(80);
  const Rig& rig = probe::head();
  PatternImagesOptions options = quiet();
  options.grey_noise = 1.5;
  const DepthScan decoded = decode::structured_light(images_of(rig, options, at), at.camera, at.projector);
  const DepthScan scan = scan_frame(rig, plain::still_face(), plain::still_head(), at.camera, at.projector, nullptr,
                                    nullptr, nullptr, exact())
                             .scan;
  std::vector<double> errors = differences(decoded, scan);
  ASSERT_GT(errors.size(), 14000u);
  for (double& error : errors) error = std::abs(error);
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.2);
  const auto outliers = std::count_if(errors.begin(), errors.end(), [](double error) { return error > 3; });
  EXPECT_LT(static_cast<double>(outliers), 0.003 * static_cast<double>(errors.size()));
  // Nothing is decoded that the scan does not see, and nothing is missing that is bright enough: the decoder asks for
  // an amplitude of 9, which is a signal of 0.083; noise and edges take the rest.
  ScanFrameOptions bright_enough = exact();
  bright_enough.min_signal = 0.12;
  bright_enough.max_angle_deg = 75;
  const DepthScan bright = scan_frame(rig, plain::still_face(), plain::still_head(), at.camera, at.projector, nullptr,
                                      nullptr, nullptr, bright_enough)
                               .scan;
  int holes = 0, invented = 0, both = 0;
  for (std::size_t i = 0; i < scan.depth_mm.size(); ++i) {
    holes += bright.depth_mm[i] > 0 && decoded.depth_mm[i] == 0 ? 1 : 0;
    invented += scan.depth_mm[i] == 0 && decoded.depth_mm[i] > 0 ? 1 : 0;
    both += scan.depth_mm[i] > 0 && decoded.depth_mm[i] > 0 ? 1 : 0;
  }
  EXPECT_EQ(invented, 0);
  EXPECT_LT(holes, 0.02 * both);
  // The picture is the scan's.
  double difference = 0;
  for (std::size_t i = 0; i < scan.picture.pixels.size(); ++i)
    if (decoded.depth_mm[i] > 0) difference += std::abs(scan.picture.pixels[i] - decoded.picture.pixels[i]);
  EXPECT_LT(difference / both, 3);
}

TEST(PatternImages, OfAMovingPlaneDecodeToItsDepthAtTheMiddle) {
  const Scanner at = scanner();
  PatternImagesOptions options = quiet();
  options.exposure_step = 0.2;
  const auto faces = plain::window<Weights>({{}, {}, {}}, 1);
  const auto heads =
      plain::window<RigidMotion>({plain::moved(0, 0, -2), plain::moved(0, 0, 0), plain::moved(0, 0, 2)}, 1);
  const DepthScan scan =
      decode::structured_light(images_of(plain::wall(420, 0), options, at, faces, heads), at.camera, at.projector);
  std::vector<double> errors;
  for (const float depth : scan.depth_mm)
    if (depth > 0) errors.push_back(depth - 1000);
  EXPECT_GT(errors.size(), 60000u);
  EXPECT_NEAR(plain::spread_of(errors).mean, 0, 0.05);
  // 0.4 mm per picture: the ripple that scan_frame's parameter states as half of that, times a sine.
  EXPECT_GT(plain::spread_of(errors).deviation, 0.1);
  EXPECT_LT(plain::spread_of(errors).deviation, 0.4);
}

}  // namespace
}  // namespace face::phantom
