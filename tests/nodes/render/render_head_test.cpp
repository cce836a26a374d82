// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/render_head.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/decode/read_rig.h"
#include "nodes/phantom/make_head.h"
#include "nodes/render/mouth_light.h"
#include "tests/nodes/render/test_ball.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/folder_file.h"

namespace face::render {
namespace {

using Rgb = std::array<int, 3>;

Rgb pixel(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.pixels[static_cast<std::size_t>((y * image.width + x) * 3)];
  return {p[0], p[1], p[2]};
}

int brightness(const Image& image, int x, int y) {
  const Rgb p = pixel(image, x, y);
  return p[0] + p[1] + p[2];
}

bool is_background(const Image& image, int x, int y) { return pixel(image, x, y) == pixel(image, 0, 0); }

RenderHeadOptions view(int size_px, double distance_mm, double field_of_view_deg = 30) {
  RenderHeadOptions options;
  options.width_px = options.height_px = size_px;
  options.distance_mm = distance_mm;
  options.field_of_view_deg = field_of_view_deg;
  return options;
}

Weights weight(std::string_view name, float value) {
  Weights weights;
  weights.values.assign(arkit_count, 0.0f);
  weights.values[arkit_index(name)] = value;
  return weights;
}

Image portrait(const Rig& rig, const Weights& weights, int size_px = 400) {
  RenderHeadOptions options;
  options.width_px = options.height_px = size_px;
  return render_head(rig, weights, options);
}

// Mean over the pixels about a point of the rig.
Rgb mean_about(const Image& image, const Rig& rig, const Vec3f& point_mm, int reach_px) {
  RenderHeadOptions options;
  options.width_px = image.width;
  options.height_px = image.height;
  const ScreenPoint at = project(head_camera(rig, options), point_mm);
  Rgb sum = {0, 0, 0};
  for (int y = -reach_px; y <= reach_px; ++y)
    for (int x = -reach_px; x <= reach_px; ++x) {
      const Rgb p = pixel(image, static_cast<int>(at.x_px) + x, static_cast<int>(at.y_px) + y);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += p[c];
    }
  for (int& c : sum) c /= (2 * reach_px + 1) * (2 * reach_px + 1);
  return sum;
}

TEST(RenderHead, ShowsTheFaceOfAPersonWithoutMarks) {
  // A ball of 100 mm at the top of a mesh of 1,700 mm, of which shapes move only the ball's lower half.
  Rig person = test::ball_rig(50);
  Shape& jaw = person.shapes[arkit_index("jawOpen")];
  std::erase_if(jaw.vertices, [&](std::uint32_t v) { return person.neutral.points_mm[v][1] > 0; });
  jaw.offsets_mm.resize(jaw.vertices.size());
  const Image alone = portrait(person, {});
  const auto first = static_cast<std::uint32_t>(person.neutral.points_mm.size());
  person.neutral.points_mm.insert(person.neutral.points_mm.end(), {{-5, -1650, 0}, {5, -1650, 0}, {0, -50, 0}});
  for (std::uint32_t k = 0; k < 3; ++k) person.neutral.corners.push_back(first + k);
  person.neutral.polygon_starts.push_back(static_cast<std::uint32_t>(person.neutral.corners.size()));
  const Image whole = portrait(person, {});
  const auto shown = [](const Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) count += is_background(image, x, y) ? 0 : 1;
    return count / double(image.width * image.height);
  };
  EXPECT_GT(shown(alone), 0.5);
  EXPECT_GT(shown(whole), 0.4) << "a body below takes the face its room";
}

TEST(RenderHead, ShowsABallRoundAndOfTheRightSize) {
  const Image image = render_head(test::ball_rig(80), {}, view(400, 500));
  int count = 0, low_x = 400, high_x = -1, low_y = 400, high_y = -1;
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x) {
      if (is_background(image, x, y)) continue;
      ++count;
      low_x = std::min(low_x, x);
      high_x = std::max(high_x, x);
      low_y = std::min(low_y, y);
      high_y = std::max(high_y, y);
    }
  // A ball of radius r at distance d is seen under the angle asin(r / d): its outline has the radius f tan(asin(r /
  // d)).
  const double focal_px = 200 / std::tan(15 * std::numbers::pi / 180);
  const double radius_px = focal_px * std::tan(std::asin(80.0 / 500));
  EXPECT_NEAR((high_x - low_x + 1) / 2.0, radius_px, 1);
  EXPECT_NEAR((high_y - low_y + 1) / 2.0, radius_px, 1);
  EXPECT_NEAR((high_x + low_x) / 2.0, 199.5, 0.6);
  EXPECT_NEAR(std::sqrt(count / std::numbers::pi), radius_px, 1);
}

TEST(RenderHead, KeepsTheCameraStillWhenTheFaceMoves) {
  const Rig rig = test::ball_rig(80);
  const auto top_of = [&](const Image& image) {
    for (int y = 0; y < image.height; ++y)
      if (!is_background(image, image.width / 2, y)) return y;
    return -1;
  };
  const int still = top_of(render_head(rig, {}, view(400, 800)));
  const int moved = top_of(render_head(rig, weight("jawOpen", 1), view(400, 800)));
  EXPECT_NEAR(moved - still, 30 * 200 / std::tan(15 * std::numbers::pi / 180) / 800, 2);  // 30 mm at about 800 mm
}

TEST(RenderHead, LightsTheBallFromTheFrontAndTheUpperLeft) {
  const Image image = render_head(test::ball_rig(80), {}, view(400, 500));
  const int centre = brightness(image, 200, 200);
  EXPECT_GT(centre, 300);
  EXPECT_GT(brightness(image, 150, 150), brightness(image, 250, 250));
  EXPECT_GT(centre, brightness(image, 200, 310));
}

TEST(RenderHead, ShowsTheSideThatYawAndPitchTurnTo) {
  Rig rig = test::ball_rig(80);
  rig.neutral.colors_srgb.assign(rig.neutral.points_mm.size(), {0.5f, 0.5f, 0.5f});
  for (std::size_t v = 0; v < rig.neutral.points_mm.size(); ++v) {
    if (rig.neutral.points_mm[v][0] > 60) rig.neutral.colors_srgb[v] = {1, 0, 0};  // the head's left
    if (rig.neutral.points_mm[v][1] > 60) rig.neutral.colors_srgb[v] = {0, 1, 0};  // its top
  }
  RenderHeadOptions options = view(200, 500);
  options.yaw_deg = 90;
  const Rgb left = pixel(render_head(rig, {}, options), 100, 100);
  EXPECT_GT(left[0], 3 * left[1]);
  options.yaw_deg = 0;
  options.pitch_deg = 89;
  const Rgb top = pixel(render_head(rig, {}, options), 100, 100);
  EXPECT_GT(top[1], 3 * top[0]);
}

TEST(RenderHead, LeavesOutPartsThatAreNotVisible) {
  Rig rig = test::ball_rig(80);
  const auto covered = [&] {
    const Image image = render_head(rig, {}, view(200, 2000, 10));
    int count = 0;
    for (int y = 0; y < 200; ++y) count += !is_background(image, 100, y);
    return count;
  };
  const int whole = covered();
  const auto half = static_cast<std::uint32_t>(rig.neutral.polygon_count() / 2);
  rig.neutral.parts = {{"upper", 0, half, {1, 1, 1}, 0, false}, {"lower", half, half, {1, 1, 1}, 0, true}};
  EXPECT_NEAR(covered(), whole / 2, whole / 20);
}

TEST(RenderHead, GivesTheSamePictureTwiceAndFromManyThreads) {
  const Rig rig = phantom::make_head();
  const Image expected = portrait(rig, weight("jawOpen", 0.5f), 200);
  std::vector<Image> images(3);
  std::vector<std::thread> threads;
  for (Image& image : images) threads.emplace_back([&] { image = portrait(rig, weight("jawOpen", 0.5f), 200); });
  for (std::thread& thread : threads) thread.join();
  for (const Image& image : images) EXPECT_EQ(image.pixels, expected.pixels);
}

TEST(RenderHead, HasSmoothEdges) {
  RenderHeadOptions options = view(100, 500);
  options.background_red = options.background_green = options.background_blue = 0;
  const Image smooth = render_head(test::ball_rig(80), {}, options);
  options.samples = 1;
  const Image hard = render_head(test::ball_rig(80), {}, options);
  // Along the left edge of the ball: the smooth picture has values between background and ball.
  const auto between = [](const Image& image) {
    int count = 0;
    for (int y = 30; y < 70; ++y)
      for (int x = 1; x < 49; ++x) {
        const int here = brightness(image, x, y), inner = brightness(image, x + 2, y);
        count += brightness(image, x - 1, y) == 0 && here > 0 && here < inner / 2;
      }
    return count;
  };
  EXPECT_GT(between(smooth), 2 * between(hard));
}

// The lower lip and the jaw go down, so what was lip is mouth: dark, but not black where the tongue is.
void expect_an_open_mouth(const Rig& rig) {
  const Image closed = portrait(rig, {}), open = portrait(rig, weight("jawOpen", 0.6f));
  const LipPair pair = rig.inner_lips[rig.inner_lips.size() / 2];
  Vec3f below = rig.neutral.points_mm[pair.upper];
  below[1] -= 7;
  const Rgb lip = mean_about(closed, rig, below, 2), mouth = mean_about(open, rig, below, 2);
  EXPECT_LT(mouth[0], 0.85 * lip[0]);
  EXPECT_LT(mouth[1], 0.7 * lip[1]);
}

// Skin has more red than green than blue, and is neither dark nor burnt out.
void expect_skin(const Rig& rig, const Vec3f& point_mm) {
  const Rgb skin = mean_about(portrait(rig, {}), rig, point_mm, 2);
  EXPECT_GT(skin[0], skin[1] + 15);
  EXPECT_GT(skin[1], skin[2]);
  EXPECT_GT(skin[0], 120);
  EXPECT_LT(skin[0], 253);
}

TEST(RenderHead, ShowsTheEmbeddedHeadAsAFace) {
  const Rig rig = phantom::make_head();
  expect_an_open_mouth(rig);
  expect_skin(rig, {0, 60, 100});  // the forehead
}

TEST(RenderHead, ShowsTheIctHeadAsAFace) {
  DATA_FILE(folder, "ict-face/FaceXModel");
  const Rig rig = decode::read_rig(test::folder_file(folder), nullptr);
  expect_an_open_mouth(rig);
  Vec3f forehead = rig.neutral.points_mm[rig.landmarks68[27]];
  forehead[1] += 35;
  expect_skin(rig, forehead);
  // The iris is blue and the white of the eye is white; a blink hides both behind skin.
  Vec3f eye = {0, 0, 0};
  for (std::size_t i = 42; i < 48; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) eye[axis] += rig.neutral.points_mm[rig.landmarks68[i]][axis] / 6;
  Weights blink = weight("eyeBlinkLeft", 1);
  const Rgb open = mean_about(portrait(rig, {}), rig, eye, 1), shut = mean_about(portrait(rig, blink), rig, eye, 1);
  EXPECT_LT(open[0], shut[0] - 40);
  EXPECT_GT(shut[0], shut[2] + 15);
}

TEST(RenderHead, RejectsWhatItCannotShow) {
  EXPECT_THROW_TEXT(render_head(Rig{}, {}), "the rig has no visible polygon to render");
  const Rig rig = test::ball_rig(80);
  RenderHeadOptions options;
  options.samples = 0;
  EXPECT_THROW_TEXT(render_head(rig, {}, options), "samples is 0, expected at least 1");
  options = {};
  options.width_px = 0;
  EXPECT_THROW_TEXT(render_head(rig, {}, options), "the picture is 0 x 640 pixels, expected at least 1 x 1");
  EXPECT_THROW_TEXT(render_head(rig, Weights{std::vector<float>(60)}),
                    "there are 60 weights, but the rig has 52 shapes");
  Rig odd = rig;
  odd.neutral.colors_srgb.resize(3);
  EXPECT_THROW_TEXT(render_head(odd, {}),
                    message("the rig has 3 vertex colours, but ", rig.neutral.points_mm.size(), " vertices"));
}

TEST(MouthLight, GrowsWithTheOpeningAndLeavesTheFaceAlone) {
  const Rig rig = phantom::make_head();
  std::vector<Vec3f> closed = rig.neutral.points_mm, open = closed;
  add_shape(rig.shapes[arkit_index("jawOpen")], 0.6f, open);
  const MouthLight dark = mouth_light(rig, closed), light = mouth_light(rig, open);
  const std::uint32_t tooth = rig.upper_teeth.at(0);
  EXPECT_TRUE(dark.inside[tooth]);
  EXPECT_LT(dark.exposure[tooth], 0.2f);
  EXPECT_GT(light.exposure[tooth], 3 * dark.exposure[tooth]);
  for (std::size_t v = 0; v < light.exposure.size(); ++v) {
    ASSERT_GE(light.exposure[v], 0.0f);
    ASSERT_LE(light.exposure[v], 1.0f);
    ASSERT_TRUE(light.inside[v] || light.exposure[v] == 1.0f);
  }
  const Part& face = rig.neutral.parts.at(0);
  ASSERT_EQ(face.name, "face");
  EXPECT_FALSE(light.inside[rig.neutral.corners[rig.neutral.polygon_starts[face.first_polygon]]]);
  EXPECT_NEAR(light.opening_mm[0], 0, 1);
}

TEST(MouthLight, IsRedWhereItComesFromTheWalls) {
  const Rig rig = phantom::make_head();
  std::vector<Vec3f> open = rig.neutral.points_mm;
  const Vec3f closed = mouth_light(rig, open).bounced;
  EXPECT_GT(closed[0], 0.0f);  // never black
  add_shape(rig.shapes[arkit_index("jawOpen")], 0.6f, open);
  const Vec3f bounced = mouth_light(rig, open).bounced;
  EXPECT_GT(bounced[0], 2 * closed[0]);
  EXPECT_GT(bounced[0], 3 * bounced[1]);
  EXPECT_GT(bounced[1], bounced[2]);
  EXPECT_LT(bounced[0], 0.5f);
}

}  // namespace
}  // namespace face::render
