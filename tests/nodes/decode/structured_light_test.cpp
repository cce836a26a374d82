// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/structured_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/base/fringe_patterns.h"
#include "tests/support/expect_throw_text.h"

namespace face::decode {
namespace {

constexpr int width = 160, height = 120;

Camera camera_at(double yaw_rad, float focal_px, float centre_x_px, float centre_y_px) {
  const auto c = static_cast<float>(std::cos(yaw_rad)), s = static_cast<float>(std::sin(yaw_rad));
  Camera camera;
  camera.cam_from_world = {c, 0, -s, 0, 1, 0, s, 0, c};
  camera.position_mm = {1000 * s, 0, 1000 * c};
  camera.focal_px = focal_px;
  camera.centre_x_px = centre_x_px;
  camera.centre_y_px = centre_y_px;
  return camera;
}
Camera scanner() { return camera_at(0, 450, 79.5f, 59.5f); }
Camera projector() { return camera_at(-0.3, 2000, 511.5f, 383.5f); }

// What a camera at (0, 0, 1000) sees of the plane z = z_mm under each pattern. Every fourth column is darker: albedo
// must not matter.
std::vector<Image> plane(double z_mm) {
  const FringePatterns patterns;
  const Camera from = scanner(), lamp = projector();
  std::vector<Image> images(FringePatterns::count, Image{width, height, 1, {}});
  for (std::size_t k = 0; k < images.size(); ++k)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double px = (x - from.centre_x_px) * (1000 - z_mm) / from.focal_px;
        const auto& r = lamp.cam_from_world;
        const double dx = px - lamp.position_mm[0], dz = z_mm - lamp.position_mm[2];
        const double column = lamp.centre_x_px + lamp.focal_px * (r[0] * dx + r[2] * dz) / -(r[6] * dx + r[8] * dz);
        const double albedo = x % 4 == 0 ? 0.3 : 0.8;
        images[k].pixels.push_back(
            static_cast<std::uint8_t>(std::lround(255 * albedo * (0.1 + 0.9 * patterns.light(k, column)))));
      }
  return images;
}

TEST(StructuredLight, FindsTheDepthOfAPlane) {
  for (const double z_mm : {-100.0, 0.0, 120.0}) {
    const DepthScan scan = structured_light(engine::Seq<Image>(plane(z_mm)), scanner(), projector());
    ASSERT_EQ(scan.depth_mm.size(), static_cast<std::size_t>(width * height));
    std::size_t found = 0;
    for (const float depth : scan.depth_mm) {
      if (depth == 0) continue;
      ++found;
      ASSERT_NEAR(depth, 1000 - z_mm, 1.0) << z_mm;  // 8 bits at an amplitude of 34: 0.01 periods of 32 px
    }
    EXPECT_GT(found, scan.depth_mm.size() * 99 / 100) << z_mm;
  }
}

TEST(StructuredLight, ReturnsThePictureInEvenLight) {
  const DepthScan scan = structured_light(engine::Seq<Image>(plane(0)), scanner(), projector());
  // Albedo 0.8 and 0.3 in full light, as sRGB: 0.9063 and 0.5838.
  EXPECT_NEAR(scan.picture.pixels[60 * width + 81], 231, 2);
  EXPECT_NEAR(scan.picture.pixels[60 * width + 80], 149, 2);
}

TEST(StructuredLight, MeasuresNothingBeyondTheRange) {
  StructuredLightOptions options;
  options.near_mm = 900;
  options.far_mm = 950;
  const DepthScan scan = structured_light(engine::Seq<Image>(plane(0)), scanner(), projector(), options);
  EXPECT_EQ(std::count_if(scan.depth_mm.begin(), scan.depth_mm.end(), [](float depth) { return depth > 0; }), 0);
}

TEST(StructuredLight, MeasuresNothingInTheDarkAndWhereItIsTooBright) {
  for (const int level : {3, 255}) {
    std::vector<Image> images(5, Image{8, 8, 1, std::vector<std::uint8_t>(64, static_cast<std::uint8_t>(level))});
    const DepthScan scan = structured_light(engine::Seq<Image>(std::move(images)), scanner(), projector());
    for (const float depth : scan.depth_mm) EXPECT_EQ(depth, 0);
  }
}

TEST(StructuredLight, NeedsFiveImagesOfASize) {
  EXPECT_THROW_TEXT(structured_light(engine::Seq<Image>(std::vector<Image>(4)), scanner(), projector()),
                    "there are 4 pattern images, expected 5");
  std::vector<Image> images(5, Image{2, 1, 1, {0, 0}});
  images[3] = {1, 1, 1, {0}};
  EXPECT_THROW_TEXT(structured_light(engine::Seq<Image>(std::move(images)), scanner(), projector()),
                    "pattern image 3 is 1 x 1 x 1, expected 2 x 1 x 1");
}

}  // namespace
}  // namespace face::decode
