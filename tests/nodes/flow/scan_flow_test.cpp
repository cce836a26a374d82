// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/scan_flow.h"

#include <gtest/gtest.h>

#include "nodes/flow/opencv_flow.h"
#include "nodes/flow/scan_channels.h"
#include "tests/nodes/flow/moving_picture.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/scan_frames.h"

namespace {

using namespace face;
using namespace face::flow;

FlowField found(const FeatureMap& a, const FeatureMap& b, const ScanFlowOptions& options = {}) {
  return scan_flow(a, b, nullptr, options);
}

// A scan of the embedded head without what is inside mouth and eyes.
struct Scan {
  test::ScanScene::Frame frame;
  FeatureMap channels;
};

Scan scan_of(const test::ScanScene& scene, const std::map<std::string, float>& pose, std::uint64_t seed) {
  Scan scan{scene.frame(scene.points(pose), seed), {}};
  for (std::size_t i = 0; i < scan.frame.scan.depth_mm.size(); ++i)
    if (scan.frame.inside_mouth[i]) scan.frame.scan.depth_mm[i] = 0;
  scan.channels = scan_channels(scan.frame.scan, nullptr);
  return scan;
}

// Errors in mm about the mouth, sorted.
std::vector<double> mouth_errors_mm(const Scan& scan, const FlowField& truth, const FlowField& flow) {
  std::vector<double> errors;
  const Camera& camera = scan.frame.scan.camera;
  for (int y = 0; y < flow.height; ++y)
    for (int x = 0; x < flow.width; ++x) {
      const auto i = static_cast<std::size_t>(y * flow.width + x);
      if (!truth.valid[i] || !(scan.frame.scan.depth_mm[i] > 0)) continue;
      const double scale = static_cast<double>(scan.frame.scan.depth_mm[i] / camera.focal_px);
      const double px = (x - static_cast<double>(camera.centre_x_px)) * scale,
                   py = static_cast<double>(camera.position_mm[1]) -
                        (y - static_cast<double>(camera.centre_y_px)) * scale;
      if (std::fabs(px) > 35 || py > -10 || py < -70) continue;
      errors.push_back(scale *
                       std::hypot(static_cast<double>(flow.displacement_px[i][0] - truth.displacement_px[i][0]),
                                  static_cast<double>(flow.displacement_px[i][1] - truth.displacement_px[i][1])));
    }
  std::sort(errors.begin(), errors.end());
  return errors;
}

}  // namespace

// Off the border: what leaves the picture has no counterpart.
TEST(ScanFlow, FindsAKnownTranslationToAThirtiethOfAPixel) {
  for (const auto& [u, v] : {std::pair{0.3f, -0.6f}, std::pair{4.2f, 2.7f}, std::pair{-9.6f, 3.3f}}) {
    const test::Motion motion = [u = u, v = v](double, double) { return Vec2f{u, v}; };
    EXPECT_LE(test::mean_error_px(found(test::still(), test::picture(160, 120, motion)), motion, 24), 0.03) << u;
  }
}

// Read between its pixels by a line, the target alone is blurred, and dots are found to grow by 0.05 px on every side.
TEST(ScanFlow, FindsDotsBetweenPixelsAsLargeAsTheyAre) {
  const auto dots = [](double shift) {
    FeatureMap map{160, 120, {"grey"}, {}, {}};
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        const double r = std::hypot(std::remainder(x - shift - 10, 20), std::remainder(y - shift - 10, 20));
        map.values.push_back(static_cast<float>(75 + 165 * 0.5 * std::erfc((r - 2.6) / (0.6 * std::sqrt(2.0)))));
      }
    map.valid.assign(map.values.size(), 1);
    return map;
  };
  const FlowField flow = found(dots(0), dots(0.5), {.smoothness = 15, .search = false});
  double outwards = 0, count = 0;
  for (int y = 20; y < 100; ++y)
    for (int x = 20; x < 140; ++x) {
      const double dx = std::remainder(x - 10, 20), dy = std::remainder(y - 10, 20), r = std::hypot(dx, dy);
      if (r < 1.5 || r > 4) continue;
      const Vec2f& d = flow.displacement_px[static_cast<std::size_t>(y * flow.width + x)];
      outwards += ((static_cast<double>(d[0]) - 0.5) * dx + (static_cast<double>(d[1]) - 0.5) * dy) / r;
      ++count;
    }
  EXPECT_LE(std::fabs(outwards / count), 0.01);
}

TEST(ScanFlow, FindsARotationAndAStretchToATwentiethOfAPixel) {
  const test::Motion motion = [](double x, double y) {
    return Vec2f{static_cast<float>(0.04 * (x - 80) - 0.06 * (y - 60)),
                 static_cast<float>(0.06 * (x - 80) - 0.03 * (y - 60))};
  };
  EXPECT_LE(test::mean_error_px(found(test::still(), test::picture(160, 120, motion)), motion), 0.05);
}

TEST(ScanFlow, GivesNoMotionForEqualPictures) {
  const FlowField flow = found(test::still(), test::still());
  for (const Vec2f& d : flow.displacement_px) EXPECT_LE(std::hypot(d[0], d[1]), 1e-4f);
}

TEST(ScanFlow, DoesNotLookAtWhatIsNotMeasured) {
  const test::Motion motion = [](double, double) { return Vec2f{2, 1}; };
  FeatureMap a = test::still(), b = test::picture(160, 120, motion);
  for (int y = 40; y < 70; ++y)
    for (int x = 50; x < 90; ++x) a.valid[static_cast<std::size_t>(y * 160 + x)] = 0;
  for (int y = 20; y < 50; ++y)
    for (int x = 100; x < 120; ++x) b.valid[static_cast<std::size_t>(y * 160 + x)] = 0;
  const FlowField flow = found(a, b);
  FeatureMap other_a = a, other_b = b;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    if (!a.valid[i]) other_a.values[i] = static_cast<float>(i % 251);
    if (!b.valid[i]) other_b.values[i] = 255 - static_cast<float>(i % 97);
  }
  const FlowField other = found(other_a, other_b);
  EXPECT_EQ(flow.displacement_px, other.displacement_px);
  EXPECT_EQ(flow.valid, other.valid);
  EXPECT_EQ(flow.valid[50 * 160 + 70], 0);   // reference not measured
  EXPECT_EQ(flow.valid[30 * 160 + 108], 0);  // target not measured there
  EXPECT_LE(test::mean_error_px(flow, motion), 0.05);
}

TEST(ScanFlow, IsUnchangedWhenAChannelComesInAnotherUnit) {
  const test::Motion motion = [](double, double) { return Vec2f{1.5f, -2.5f}; };
  FeatureMap a = test::still(), b = test::picture(160, 120, motion);
  const FlowField flow = found(a, b);
  for (float& x : a.values) x *= 1024;
  for (float& x : b.values) x *= 1024;
  EXPECT_EQ(flow.displacement_px, found(a, b).displacement_px);
}

TEST(ScanFlow, FollowsRadiusWhereGreyIsFlat) {
  const test::Motion motion = [](double, double) { return Vec2f{2.5f, 1.5f}; };
  FeatureMap a = test::still(), b = test::picture(160, 120, motion);
  for (FeatureMap* map : {&a, &b}) {
    map->names = {"radius", "grey"};
    map->values.insert(map->values.end(), map->values.begin(), map->values.end());
    std::fill(map->values.begin() + 160 * 120, map->values.end(), 90.0f);
  }
  EXPECT_LE(test::mean_error_px(found(a, b), motion), 0.1);
}

TEST(ScanFlow, FindsAMotionOfAQuarterOfThePictureFromAStart) {
  const test::Motion motion = [](double, double) { return Vec2f{40, 0}; };
  FlowField start{160, 120, std::vector<Vec2f>(160 * 120, {38, 1}), std::vector<std::uint8_t>(160 * 120, 1)};
  const FlowField flow = scan_flow(test::still(), test::picture(160, 120, motion), &start);
  EXPECT_LE(test::mean_error_px(flow, motion), 0.02);
}

TEST(ScanFlow, DimmedLightMovesNothing) {
  FeatureMap b = test::still();
  for (float& x : b.values) x = x * 0.95f + 9;
  const test::Motion none = [](double, double) { return Vec2f{0, 0}; };
  EXPECT_LE(test::mean_error_px(found(test::still(), b), none), 0.05);
}

TEST(ScanFlow, KeepsAnEvenPictureStill) {
  FeatureMap a = test::still();
  std::fill(a.values.begin(), a.values.end(), 80.0f);
  for (const Vec2f& d : found(a, a).displacement_px) EXPECT_LE(std::hypot(d[0], d[1]), 1e-6f);
}

TEST(ScanFlow, AcceptsAPictureWithoutAnythingMeasured) {
  FeatureMap a = test::still();
  std::fill(a.valid.begin(), a.valid.end(), std::uint8_t{0});
  const FlowField flow = found(a, test::still());
  EXPECT_EQ(std::count(flow.valid.begin(), flow.valid.end(), 1), 0);
}

TEST(ScanFlow, IsNearerToTheTruthAboutAMouthThanDenseInverseSearchAndFarneback) {
  test::ScanLook look;
  look.noise_mm = 0.15;
  look.noise_grey = 2;
  const test::ScanScene scene(look);
  const Scan reference = scan_of(scene, {{"jawOpen", 0.12f}}, 1);
  for (const auto& pose :
       {std::map<std::string, float>{{"jawOpen", 0.4f}, {"mouthFunnel", 0.7f}},
        std::map<std::string, float>{{"mouthSmileLeft", 0.8f}, {"mouthSmileRight", 0.8f}, {"jawOpen", 0.1f}}}) {
    const Scan target = scan_of(scene, pose, 2);
    const FlowField truth = scene.truth(reference.frame, target.frame);
    const auto errors = mouth_errors_mm(reference, truth, found(reference.channels, target.channels));
    EXPECT_LE(errors[errors.size() / 2], 0.25);
    EXPECT_LE(errors[errors.size() * 95 / 100], 1.2);
    for (const char* channel : {"grey", "radius"}) {
      const auto dis =
          mouth_errors_mm(reference, truth, dis_flow(reference.channels, target.channels, nullptr, {channel}));
      const auto farneback =
          mouth_errors_mm(reference, truth, farneback_flow(reference.channels, target.channels, nullptr, {channel}));
      EXPECT_LT(errors[errors.size() / 2], dis[dis.size() / 2]) << channel;
      EXPECT_LT(errors[errors.size() * 95 / 100], dis[dis.size() * 95 / 100]) << channel;
      EXPECT_LT(errors[errors.size() / 2], farneback[farneback.size() / 2]) << channel;
      EXPECT_LT(errors[errors.size() * 95 / 100], farneback[farneback.size() * 95 / 100]) << channel;
    }
  }
}

TEST(ScanFlow, RejectsWhatCannotBeCompared) {
  const FeatureMap a = test::still();
  EXPECT_THROW_TEXT(found(a, test::still(150, 120)), "target is 150 x 120 pixels, reference 160 x 120");
  FeatureMap b = a;
  b.names = {"radius"};
  EXPECT_THROW_TEXT(found(a, b), "target and reference have different channels");
  b = a;
  b.values.pop_back();
  EXPECT_THROW_TEXT(found(a, b), "target has 19199 values, expected 1 x 120 x 160");
  const FlowField start{10, 10, {}, {}};
  EXPECT_THROW_TEXT(scan_flow(a, a, &start), "start is 10 x 10 pixels, reference 160 x 120");
  ScanFlowOptions options;
  options.window_px = 4;
  EXPECT_THROW_TEXT(found(a, a, options), "window_px is 4, expected an odd number");
}
