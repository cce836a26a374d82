// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/video_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/phantom/make_backdrop.h"
#include "nodes/phantom/make_camera.h"
#include "nodes/phantom/make_lighting.h"
#include "tests/nodes/phantom/head_probe.h"
#include "tests/nodes/phantom/plain_rigs.h"
#include "tests/support/expect_throw_text.h"

namespace face::phantom {
namespace {

VideoFrameOptions plain_options() {
  VideoFrameOptions options;
  options.width_px = 160;
  options.height_px = 120;
  options.highlight = options.shadow = options.gamma = false;
  options.grain = 0;
  return options;
}

Camera camera(double target_z_mm = 0) {
  MakeCameraOptions options;
  options.width_px = 160;
  options.height_px = 120;
  options.target_y_mm = 0;
  options.target_z_mm = target_z_mm;
  return make_camera(options);
}

Image frame(const Rig& rig, const Lighting& lighting, const VideoFrameOptions& options, const std::string& id = "0",
            const RigidMotion* motion = nullptr) {
  return video_frame(rig, {}, motion, camera(), lighting, nullptr, nullptr, &id, options);
}

int red(const Image& image, int x, int y) { return image.pixels[static_cast<std::size_t>(3 * (y * image.width + x))]; }
int green(const Image& image, int x, int y) {
  return image.pixels[static_cast<std::size_t>(3 * (y * image.width + x) + 1)];
}

TEST(VideoFrame, IsTheLightingEquationWhereAllElseIsOff) {
  const Vec3f albedo = {0.8f, 0.5f, 0.4f};
  const Rig rig = plain::grid(
      4, 4,
      [](double u, double v) {
        return std::array<double, 3>{500 * (u - 0.5), 500 * (v - 0.5), 0};
      },
      albedo);
  Lighting lighting;
  lighting.ambient = {0.2f, 0.25f, 0.3f};
  lighting.parallel = {0.7f, 0.6f, 0.5f};
  lighting.towards_light = {0.6f, 0, 0.8f};
  lighting.contrast = 0.7f;
  lighting.gain = {0.9f, 1.1f, 1};
  lighting.offset = {0.05f, -0.02f, 0};
  const Image image = frame(rig, lighting, plain_options());
  Vec3f light;
  for (std::size_t c = 0; c < 3; ++c) light[c] = (lighting.ambient[c] + lighting.parallel[c] * 0.8f) * albedo[c];
  const float luminance = 0.3f * light[0] + 0.59f * light[1] + 0.11f * light[2];
  for (std::size_t c = 0; c < 3; ++c) {
    const float expected = lighting.gain[c] * (0.7f * light[c] + 0.3f * luminance) + lighting.offset[c];
    EXPECT_EQ(image.pixels[3 * (60 * 160 + 80) + c], std::lround(255 * expected)) << c;
  }
}

TEST(VideoFrame, CodesLightAsSrgbWithGamma) {
  Lighting lighting;
  lighting.ambient = {0.5f, 0.5f, 0.5f};
  lighting.parallel = {0, 0, 0};
  VideoFrameOptions options = plain_options();
  options.gamma = true;
  // Albedo 0.6 in sRGB is 0.3185 in light; half of it is coded as 0.4361.
  EXPECT_EQ(red(frame(plain::wall(500, 0), lighting, options), 80, 60), 111);
  options.gamma = false;
  EXPECT_EQ(red(frame(plain::wall(500, 0), lighting, options), 80, 60), 77);
}

TEST(VideoFrame, TurnsWithTheHeadUnderALightThatStaysWhereItIs) {
  Lighting lighting;
  lighting.ambient = {0, 0, 0};
  lighting.parallel = {1, 1, 1};
  lighting.towards_light = {0, 0, 1};
  const RigidMotion turned = plain::moved(0, 0, 0, 0.5);
  const Image image = frame(plain::wall(900, 0), lighting, plain_options(), "0", &turned);
  EXPECT_EQ(red(image, 80, 60), std::lround(255 * 0.6 * std::cos(0.5)));
}

TEST(VideoFrame, HasGrainOfTheGivenDeviation) {
  VideoFrameOptions options = plain_options();
  const Rig rig = plain::wall(500, 0);
  const Image exact = frame(rig, {}, options);
  options.grain = 5;
  const Image noisy = frame(rig, {}, options);
  std::vector<double> errors;
  for (std::size_t i = 0; i < exact.pixels.size(); ++i)
    errors.push_back(static_cast<double>(noisy.pixels[i]) - exact.pixels[i]);
  // 57,600 values: 5 standard errors, and the rounding of 8 bits.
  EXPECT_NEAR(plain::spread_of(errors).deviation, 5, 0.1);
  EXPECT_NEAR(plain::spread_of(errors).mean, 0, 0.6);
}

TEST(VideoFrame, HasAHighlightAndAShadowWithASwitchEach) {
  Rig rig = plain::ball(60);
  rig.neutral.parts = {{"face", 0, static_cast<std::uint32_t>(rig.neutral.polygon_count()), {1, 1, 1}, 0.9f, true}};
  Lighting lighting;
  lighting.towards_light = {0, 0, 1};
  VideoFrameOptions options = plain_options();
  options.gamma = true;
  const int matt = green(frame(rig, lighting, options), 80, 60);
  options.highlight = true;
  EXPECT_GT(green(frame(rig, lighting, options), 80, 60), matt + 8);
  // A wall behind a ball, lit from the upper left: the ball's shadow lies on it to the lower right.
  Rig scene = plain::ball(40);
  const auto first = static_cast<std::uint32_t>(scene.neutral.points_mm.size());
  const auto corners = static_cast<std::uint32_t>(scene.neutral.corners.size());
  const Rig wall = plain::wall(600, -60, 100);
  for (const Vec3f& p : wall.neutral.points_mm) scene.neutral.points_mm.push_back(p);
  for (const Vec3f& c : wall.neutral.colors_srgb) scene.neutral.colors_srgb.push_back(c);
  for (const std::uint32_t c : wall.neutral.corners) scene.neutral.corners.push_back(first + c);
  for (std::size_t i = 1; i < wall.neutral.polygon_starts.size(); ++i)
    scene.neutral.polygon_starts.push_back(corners + wall.neutral.polygon_starts[i]);
  lighting.towards_light = {-0.6f, 0, 0.8f};  // the shadow's middle is at x = 45 mm on the wall
  options = plain_options();
  const int x = 80 + static_cast<int>(60 * camera().focal_px / 1060);
  const int lit = red(frame(scene, lighting, options), x, 60);
  options.shadow = true;
  EXPECT_LT(red(frame(scene, lighting, options), x, 60), 0.65 * lit);
  EXPECT_GT(red(frame(scene, lighting, options), 160 - x, 60), 0.8 * lit);
}

TEST(VideoFrame, ShowsTheBackdropWhereNothingIs) {
  MakeBackdropOptions wall;
  wall.width_px = 160;
  wall.height_px = 120;
  const Image backdrop = make_backdrop(wall);
  VideoFrameOptions options = plain_options();
  const Image image = video_frame(plain::wall(50, 0), {}, nullptr, camera(), {}, nullptr, &backdrop, nullptr, options);
  EXPECT_TRUE(std::equal(backdrop.pixels.begin(), backdrop.pixels.begin() + 3 * 160 * 20, image.pixels.begin()));
  const plain::Spread texture = plain::spread_of(std::vector<double>(backdrop.pixels.begin(), backdrop.pixels.end()));
  EXPECT_GT(texture.deviation, 8);  // not flat
}

TEST(VideoFrame, IsTheSameForASeedAndOtherwiseNot) {
  VideoFrameOptions options = plain_options();
  options.grain = 2;
  const Rig& rig = probe::head();
  EXPECT_EQ(frame(rig, {}, options).pixels, frame(rig, {}, options).pixels);
  EXPECT_NE(frame(rig, {}, options).pixels, frame(rig, {}, options, "1").pixels);
}

TEST(VideoFrame, RejectsABackdropOfAnotherSize) {
  const Image backdrop = make_backdrop();
  EXPECT_THROW_TEXT(
      video_frame(plain::wall(50, 0, 1), {}, nullptr, camera(), {}, nullptr, &backdrop, nullptr, plain_options()),
      "the backdrop is 640 x 480 pixels, but the picture 160 x 120");
}

}  // namespace
}  // namespace face::phantom
