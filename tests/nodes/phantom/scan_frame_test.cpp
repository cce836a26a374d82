// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/scan_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/base/srgb.h"
#include "nodes/phantom/lose_points.h"
#include "nodes/phantom/make_camera.h"
#include "nodes/phantom/sensor_picture.h"
#include "nodes/render/triangulate.h"
#include "tests/nodes/phantom/head_probe.h"
#include "tests/nodes/phantom/plain_rigs.h"
#include "tests/support/expect_throw_text.h"

namespace face::phantom {
namespace {

constexpr double distance_mm = 1000;

Camera scanner(double yaw_deg = 0, int width_px = 320, int height_px = 240, double target_z_mm = 0) {
  MakeCameraOptions options;
  options.width_px = width_px;
  options.height_px = height_px;
  options.distance_mm = distance_mm;
  options.target_y_mm = 0;
  options.target_z_mm = target_z_mm;
  options.yaw_deg = yaw_deg;
  options.field_of_view_deg = 17;
  return make_camera(options);
}

// All faults off.
ScanFrameOptions clean() {
  ScanFrameOptions options;
  options.width_px = 320;
  options.height_px = 240;
  options.shadow_holes = false;
  options.noise_mm = options.dropouts = options.min_signal = options.depth_step_mm = options.exposure_step = 0;
  options.grey_noise = options.ripple = 0;
  options.max_angle_deg = 90;
  return options;
}

ScanFrameResult scan(const Rig& rig, const ScanFrameOptions& options, const std::string& id = "0") {
  return scan_frame(rig, plain::still_face(), plain::still_head(), scanner(), scanner(-17, 512, 384), nullptr, nullptr,
                    &id, options);
}

std::size_t measured(const DepthScan& scan) {
  return static_cast<std::size_t>(
      std::count_if(scan.depth_mm.begin(), scan.depth_mm.end(), [](float depth) { return depth > 0; }));
}
std::size_t covered(const SurfaceMap& map) {
  return static_cast<std::size_t>(
      std::count_if(map.triangle.begin(), map.triangle.end(), [](std::int32_t t) { return t >= 0; }));
}

// Where a pixel's measured point lies, for a scanner that looks along -z.
std::array<double, 3> point_at(const DepthScan& scan, int x, int y) {
  const double depth = scan.depth_mm[static_cast<std::size_t>(y * scan.picture.width + x)];
  return {(x - scan.camera.centre_x_px) * depth / scan.camera.focal_px + scan.camera.position_mm[0],
          (scan.camera.centre_y_px - y) * depth / scan.camera.focal_px + scan.camera.position_mm[1],
          scan.camera.position_mm[2] - depth};
}

TEST(ScanFrame, OfABallReturnsItsRadius) {
  const ScanFrameResult result = scan(plain::ball(90), clean());
  double worst = 0;
  int count = 0;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      if (result.scan.depth_mm[static_cast<std::size_t>(y * 320 + x)] == 0) continue;
      const auto p = point_at(result.scan, x, y);
      // Near the edge, where rays graze, a chord a few um inside the ball is met far from where the ball is.
      if (std::hypot(p[0], p[1]) > 85) continue;
      worst = std::max(worst, std::abs(std::hypot(p[0], p[1], p[2]) - 90));
      ++count;
    }
  EXPECT_GT(count, 14000);
  EXPECT_LT(worst, 0.01);  // the mesh's own chords are 0.0035 mm inside
}

TEST(ScanFrame, OfAPlaneReturnsItsDepth) {
  const ScanFrameResult result = scan(plain::wall(400, 30), clean());
  EXPECT_EQ(measured(result.scan), 320u * 240u);
  for (const float depth : result.scan.depth_mm) ASSERT_NEAR(depth, distance_mm - 30, 0.002);
}

TEST(ScanFrame, HasNoiseOfTheGivenDeviationOnAPlane) {
  ScanFrameOptions options = clean();
  options.noise_mm = 0.25;
  options.grazing = 0;
  std::vector<double> errors;
  for (const float depth : scan(plain::wall(400, 0), options).scan.depth_mm) errors.push_back(depth - distance_mm);
  const plain::Spread spread = plain::spread_of(errors);
  EXPECT_NEAR(spread.mean, 0, 5 * 0.25 / std::sqrt(76800.0));  // 5 standard errors
  EXPECT_NEAR(spread.deviation, 0.25, 5 * 0.25 / std::sqrt(2 * 76800.0));
}

TEST(ScanFrame, HasNoiseThatGrowsWithTheAngle) {
  ScanFrameOptions options = clean();
  options.noise_mm = 0.25;
  options.grazing = 2;
  const double angle = 60 * std::numbers::pi / 180;
  const Rig steep = plain::grid(20, 20, [&](double u, double v) {
    return std::array<double, 3>{800 * (u - 0.5) * std::cos(angle), 400 * (v - 0.5), 800 * (u - 0.5) * std::sin(angle)};
  });
  ScanFrameOptions without = clean();
  const DepthScan noisy = scan(steep, options).scan, exact = scan(steep, without).scan;
  std::vector<double> errors;  // about the middle, where the angle is the plane's
  for (int y = 0; y < 240; ++y)
    for (int x = 150; x < 170; ++x) {
      const auto i = static_cast<std::size_t>(y * 320 + x);
      errors.push_back(noisy.depth_mm[i] - exact.depth_mm[i]);
    }
  const double expected = 0.25 * (1 + 2 * (1 / std::cos(angle) - 1));
  EXPECT_NEAR(plain::spread_of(errors).deviation, expected, 0.06 * expected);  // 4800 values: 5 standard errors
}

TEST(ScanFrame, LosesTheGivenShareOfPixels) {
  ScanFrameOptions options = clean();
  options.dropouts = 0.1;
  const double share = 1 - static_cast<double>(measured(scan(plain::wall(400, 0), options).scan)) / 76800;
  EXPECT_NEAR(share, 0.1, 5 * std::sqrt(0.1 * 0.9 / 76800));
}

TEST(ScanFrame, RoundsDepthToTheGivenStep) {
  ScanFrameOptions options = clean();
  options.depth_step_mm = 0.5;
  for (const float depth : scan(plain::ball(90), options).scan.depth_mm) ASSERT_EQ(depth * 2, std::round(depth * 2));
}

TEST(ScanFrame, HasAPictureWithTheGivenNoise) {
  ScanFrameOptions options = clean();
  const Image exact = scan(plain::wall(400, 0), options).scan.picture;
  options.grey_noise = 4;
  const Image noisy = scan(plain::wall(400, 0), options).scan.picture;
  std::vector<double> errors;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i)
    errors.push_back(static_cast<double>(noisy.pixels[i]) - exact.pixels[i]);
  // Rounding adds 1/12 at most; the exact picture is rounded as well.
  EXPECT_NEAR(plain::spread_of(errors).deviation, 4, 0.06);
  EXPECT_NEAR(plain::spread_of(errors).mean, 0, 0.55);
}

TEST(ScanFrame, ShowsTheSurfacesOwnGreyWithoutLight) {
  ScanFrameOptions options = clean();
  options.samples = 1;  // no pixel of the outline takes of the background
  options.lens_px = 0;
  const Rig ball = plain::ball(90);
  const ScanFrameResult lit = scan(ball, options);
  options.light = false;
  const ScanFrameResult plain = scan(ball, options);
  std::uint8_t least = 255, most = 0, least_lit = 255;
  for (std::size_t i = 0; i < plain.scan.depth_mm.size(); ++i) {
    if (!(plain.scan.depth_mm[i] > 0)) continue;
    least = std::min(least, plain.scan.picture.pixels[i]);
    most = std::max(most, plain.scan.picture.pixels[i]);
    least_lit = std::min(least_lit, lit.scan.picture.pixels[i]);
  }
  EXPECT_EQ(least, most);
  EXPECT_LT(least_lit + 50, least);
  EXPECT_EQ(plain.scan.depth_mm, lit.scan.depth_mm);
}

TEST(ScanFrame, ShowsAtAnEdgeTheMeanLightOfThePixelsArea) {
  ScanFrameOptions options = clean();
  options.light = false;
  options.lens_px = 0;
  const Camera camera = scanner();
  const double px_per_mm = camera.focal_px / distance_mm, skin = linear_of(0.6f);
  for (const double share : {0.1, 0.35, 0.55, 0.8}) {
    // The wall's right edge covers this share of the column of pixels it lies in.
    const double edge_px = 250 - 0.5 + share, half_mm = (edge_px - camera.centre_x_px) / px_per_mm;
    const Image picture = scan(plain::wall(2 * half_mm, 0), options).scan.picture;
    const auto light = [&](int x) { return linear_of(static_cast<float>(picture.pixels[120 * 320 + x]) / 255); };
    const double dark = light(252);
    EXPECT_NEAR(light(249), skin, 0.004);
    EXPECT_NEAR((light(250) - dark) / (skin - dark), share, 0.17) << share;  // 3 samples
    EXPECT_NEAR(light(251), dark, 0.004);
    options.samples = 1;  // all or nothing
    const Image hard = scan(plain::wall(2 * half_mm, 0), options).scan.picture;
    options.samples = 3;
    EXPECT_EQ(hard.pixels[120 * 320 + 250], hard.pixels[120 * 320 + (share >= 0.5 ? 249 : 251)]);
  }
}

TEST(ScanFrame, SpreadsLightByTheLensAndLosesNone) {
  constexpr int side = 15, middle = 7;
  std::vector<float> light(side * side, 0.0f);
  light[middle * side + middle] = 1;
  blur_light(light, {side, side}, 0.8);
  double sum = 0, second_moment = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double value = light[static_cast<std::size_t>(side * y + x)];
      sum += value;
      second_moment += (x - middle) * (x - middle) * value;
    }
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_NEAR(second_moment, 0.64, 0.02);
  std::vector<float> even(side * 4, 0.3f);
  blur_light(even, {side, 4}, 0.8);
  for (const float value : even) EXPECT_NEAR(value, 0.3f, 1e-6f);  // up to the edge of the picture
}

TEST(ScanFrame, HasAHoleWhereTheProjectorIsHiddenOnTheFarSide) {
  // A small wall 100 mm before a large one: from 17 degrees to the left its shadow falls to the right of it.
  Rig rig = plain::wall(400, 0, 40);
  const Rig small = plain::wall(60, 100, 10);
  const auto first = static_cast<std::uint32_t>(rig.neutral.points_mm.size());
  const auto corners = static_cast<std::uint32_t>(rig.neutral.corners.size());
  for (const Vec3f& p : small.neutral.points_mm) rig.neutral.points_mm.push_back(p);
  for (const Vec3f& c : small.neutral.colors_srgb) rig.neutral.colors_srgb.push_back(c);
  for (const std::uint32_t c : small.neutral.corners) rig.neutral.corners.push_back(first + c);
  for (std::size_t i = 1; i < small.neutral.polygon_starts.size(); ++i)
    rig.neutral.polygon_starts.push_back(corners + small.neutral.polygon_starts[i]);
  ScanFrameOptions options = clean();
  EXPECT_EQ(measured(scan(rig, options).scan), 76800u);
  options.shadow_holes = true;
  const DepthScan found = scan(rig, options).scan;
  const auto depth_at = [&](double x_mm) {  // in the plane z = 0, on the row of the middle
    const double x = found.camera.centre_x_px + x_mm * found.camera.focal_px / distance_mm;
    return found.depth_mm[static_cast<std::size_t>(120 * 320 + static_cast<int>(std::lround(x)))];
  };
  // The projector stands at (-292, 956) in (x, z); the ray past the edge (30, 100) meets z = 0 at x = 67.6.
  EXPECT_EQ(depth_at(40), 0);
  EXPECT_EQ(depth_at(64), 0);
  EXPECT_GT(depth_at(71), 0);
  EXPECT_GT(depth_at(-40), 0);  // the left is lit
}

TEST(ScanFrame, LosesSteepAndDarkPlaces) {
  ScanFrameOptions options = clean();
  options.max_angle_deg = 60;
  const DepthScan found = scan(plain::ball(90), options).scan;
  double widest = 0;  // the left side faces the projector: there the camera's angle counts
  for (int x = 0; x < 160; ++x)
    if (found.depth_mm[static_cast<std::size_t>(120 * 320 + x)] > 0)
      widest = std::max(widest, std::hypot(point_at(found, x, 120)[0], point_at(found, x, 120)[1]));
  EXPECT_NEAR(widest, 90 * std::sin((60 - 4.4) * std::numbers::pi / 180), 1.0);  // rays there lean by 4.4 degrees
  Rig dark = plain::wall(400, 0);
  for (Vec3f& colour : dark.neutral.colors_srgb) colour = {0.05f, 0.05f, 0.05f};
  options = clean();
  options.min_signal = 0.02;
  EXPECT_EQ(measured(scan(dark, options).scan), 0u);
  EXPECT_EQ(measured(scan(plain::wall(400, 0), options).scan), 76800u);
}

TEST(ScanFrame, AveragesMotionOverItsFivePictures) {
  ScanFrameOptions options = clean();
  options.exposure_step = 0.2;
  options.max_motion_mm = 10;
  // The plane comes 4 mm nearer per frame, then 8: it lies at -1.6, 0 and 3.2 mm in the first, middle, last picture.
  const auto faces = plain::window<Weights>({{}, {}, {}}, 1);
  const auto heads =
      plain::window<RigidMotion>({plain::moved(0, 0, -4), plain::moved(0, 0, 0), plain::moved(0, 0, 8)}, 1);
  const auto found = scan_frame(plain::wall(400, 0), faces, heads, scanner(), scanner(-17, 512, 384), nullptr, nullptr,
                                nullptr, options);
  // The parabola through these has the mean (-1.6 + 3.2) / 4 over five pictures.
  for (const float depth : found.scan.depth_mm) ASSERT_NEAR(depth, distance_mm - 0.4, 0.01);
  EXPECT_EQ(measured(found.scan), 76800u);
  options.ripple = 0.5;  // of 4.8 / 4 mm per picture
  std::vector<double> errors;
  for (const float depth : scan_frame(plain::wall(400, 0), faces, heads, scanner(), scanner(-17, 512, 384), nullptr,
                                      nullptr, nullptr, options)
                               .scan.depth_mm)
    errors.push_back(depth - (distance_mm - 0.4));
  EXPECT_NEAR(plain::spread_of(errors).deviation, 0.5 * 1.2 / std::sqrt(2.0), 0.02);  // of a sine
  EXPECT_NEAR(*std::max_element(errors.begin(), errors.end()), 0.6, 0.02);
  options.max_motion_mm = 2;
  EXPECT_EQ(measured(scan_frame(plain::wall(400, 0), faces, heads, scanner(), scanner(-17, 512, 384), nullptr, nullptr,
                                nullptr, options)
                         .scan),
            0u);
}

TEST(ScanFrame, IsTheSameForASeedAndOtherwiseNot) {
  ScanFrameOptions options = clean();
  options.noise_mm = 0.1;
  options.dropouts = 0.01;
  const Rig rig = plain::wall(400, 0);
  EXPECT_EQ(scan(rig, options).scan.depth_mm, scan(rig, options).scan.depth_mm);
  EXPECT_NE(scan(rig, options).scan.depth_mm, scan(rig, options, "1").scan.depth_mm);
  ScanFrameOptions other = options;
  other.seed = 2;
  EXPECT_NE(scan(rig, options).scan.depth_mm, scan(rig, other).scan.depth_mm);
}

TEST(ScanFrame, TellsWhichPointEveryPixelShows) {
  const Rig rig = plain::ball(90);
  const ScanFrameResult result = scan(rig, clean());
  EXPECT_EQ(covered(result.truth), measured(result.scan));
  for (int y = 0; y < 240; y += 7)
    for (int x = 0; x < 320; x += 7) {
      const auto i = static_cast<std::size_t>(y * 320 + x);
      if (result.truth.triangle[i] < 0) continue;
      // Triangle t of a mesh of quads belongs to polygon t / 2, whose fan is 0 1 2, 0 2 3.
      const auto t = static_cast<std::size_t>(result.truth.triangle[i]);
      const std::size_t corner = rig.neutral.polygon_starts[t / 2];
      const std::array<std::size_t, 3> fan = {corner, corner + 1 + t % 2, corner + 2 + t % 2};
      const float u = result.truth.weights[i][0], v = result.truth.weights[i][1];
      const std::array<float, 3> weights = {u, v, 1 - u - v};
      const auto p = point_at(result.scan, x, y);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k)
          sum += weights[k] * rig.neutral.points_mm[rig.neutral.corners[fan[k]]][axis];
        ASSERT_NEAR(sum, p[axis], 0.01);
      }
    }
}

TEST(ScanFrame, SeesMarkersOnTheSkin) {
  const Rig& rig = probe::head();
  SurfaceDots dots;
  SurfaceDot dot;
  dot.vertices = {rig.landmarks68[30], rig.landmarks68[30], rig.landmarks68[30]};
  dot.radius_mm = 4;
  dot.color_srgb = {0, 0, 0};
  dots.dots.push_back(dot);
  const Camera camera = scanner(0, 320, 240, 80), projector = scanner(-17, 512, 384, 80);
  const Image without =
      scan_frame(rig, plain::still_face(), plain::still_head(), camera, projector, nullptr, nullptr, nullptr, clean())
          .scan.picture;
  const Image with =
      scan_frame(rig, plain::still_face(), plain::still_head(), camera, projector, &dots, nullptr, nullptr, clean())
          .scan.picture;
  int darker = 0;
  for (std::size_t i = 0; i < with.pixels.size(); ++i) darker += with.pixels[i] + 60 < without.pixels[i] ? 1 : 0;
  const double px_per_mm = camera.focal_px / 950.0;
  EXPECT_NEAR(darker, std::numbers::pi * 16 * px_per_mm * px_per_mm, 25);
}

TEST(LosePoints, KeepsTheMouthEmptyThatOpensFromClosedLips) {
  const Rig& rig = probe::head();
  Weights open;
  open.values.assign(arkit_count, 0.0f);
  open.values[arkit_index("jawOpen")] = 0.6f;
  const Camera camera = scanner(0, 320, 240, 80), projector = scanner(-17, 512, 384, 80);
  LosePointsOptions options;
  options.width_px = 320;
  options.height_px = 240;
  options.projector_width_px = 512;
  options.projector_height_px = 384;
  const LosePointsResult closed = lose_points(rig, {}, nullptr, camera, projector, {}, options);
  const engine::Prior<LosePointsResult> before(std::make_shared<const LosePointsResult>(closed));
  const LosePointsResult opened = lose_points(rig, open, nullptr, camera, projector, before, options);
  for (std::size_t v = 0; v < closed.lost.on.size(); ++v) ASSERT_LE(closed.lost.on[v], opened.lost.on[v]);
  const std::vector<std::uint32_t> polygons = render::triangulate(rig.neutral, false).polygons;
  const auto inside = [&](const VertexMask* lost) {  // measured pixels of teeth, tongue and gums
    const ScanFrameResult result = scan_frame(rig, plain::window<Weights>({open}, 0), plain::still_head(), camera,
                                              projector, nullptr, lost, nullptr, clean());
    int count = 0;
    for (std::size_t i = 0; i < result.truth.triangle.size(); ++i) {
      if (result.truth.triangle[i] < 0 || result.scan.depth_mm[i] == 0) continue;
      const std::string part = probe::part_of(polygons[static_cast<std::size_t>(result.truth.triangle[i])]);
      count += part == "teeth" || part == "tongue" ? 1 : 0;
    }
    return count;
  };
  EXPECT_GT(inside(nullptr), 100);
  EXPECT_EQ(inside(&opened.lost), 0);
  options.share = 0;
  const LosePointsResult none = lose_points(rig, {}, nullptr, camera, projector, {}, options);
  EXPECT_EQ(std::count(none.lost.on.begin(), none.lost.on.end(), 1), 0);
}

TEST(ScanFrame, RejectsWhatDoesNotFitTogether) {
  const VertexMask lost{{1, 0}};
  EXPECT_THROW_TEXT(scan_frame(plain::wall(400, 0, 1), plain::still_face(), plain::still_head(), scanner(), scanner(),
                               nullptr, &lost, nullptr),
                    "the lost mask has 2 vertices, but the rig 4");
  EXPECT_THROW_TEXT(scan_frame(plain::wall(400, 0, 1), plain::window<Weights>({{}, {}}, 0), plain::still_head(),
                               scanner(), scanner(), nullptr, nullptr, nullptr),
                    "weights come with 2 frames, head motion with 1");
}

}  // namespace
}  // namespace face::phantom
