// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/even_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "nodes/base/srgb.h"
#include "tests/support/expect_throw_text.h"

namespace face::mask {
namespace {

constexpr int size = 80;
constexpr double radius_mm = 60;

std::size_t at(int x, int y) { return static_cast<std::size_t>(y * size + x); }

// A ball 200 mm away in a lamp from one side and above; a dark spot on it.
DepthScan ball(double lamp_x, double lamp_y, double ambient) {
  DepthScan scan;
  scan.camera.focal_px = 2000;
  scan.camera.centre_x_px = scan.camera.centre_y_px = 0.5f * (size - 1);
  scan.picture = {size, size, 1, {}};
  const double lamp_z = std::sqrt(1 - lamp_x * lamp_x - lamp_y * lamp_y);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double u = (x - 39.5) * 1000 / 2000, v = -(y - 39.5) * 1000 / 2000;  // 1 m away: half a millimetre a pixel
      const double nx = u / 30, ny = v / 30, square = nx * nx + ny * ny;
      if (square > 0.9) {
        scan.depth_mm.push_back(0);
        scan.picture.pixels.push_back(7);
        continue;
      }
      const double nz = std::sqrt(1 - square);
      scan.depth_mm.push_back(static_cast<float>(1000 - 30 * nz));
      const double albedo = std::hypot(x - 50, y - 30) < 4 ? 0.1 : 0.4;
      const double light = ambient + std::max(0.0, nx * lamp_x + ny * lamp_y + nz * lamp_z);
      scan.picture.pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * srgb_of(albedo * light))));
    }
  return scan;
}

}  // namespace

TEST(EvenLight, TakesALampOffABallAndLeavesItsSpots) {
  const DepthScan lit = ball(-0.4, 0.3, 0.2), even = even_light(lit);
  EXPECT_EQ(even.depth_mm, lit.depth_mm);
  int before_least = 255, before_most = 0, least = 255, most = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double away = std::hypot(x - 39.5, y - 39.5);
      if (lit.depth_mm[at(x, y)] == 0) {
        EXPECT_EQ(even.picture.pixels[at(x, y)], 7);
        continue;
      }
      if (away > 45 || std::hypot(x - 50, y - 30) < 6) continue;
      before_least = std::min<int>(before_least, lit.picture.pixels[at(x, y)]);
      before_most = std::max<int>(before_most, lit.picture.pixels[at(x, y)]);
      least = std::min<int>(least, even.picture.pixels[at(x, y)]);
      most = std::max<int>(most, even.picture.pixels[at(x, y)]);
    }
  EXPECT_GT(before_most - before_least, 60);
  EXPECT_LT(most - least, 12);
  const double share = linear_of(even.picture.pixels[at(50, 30)] / 255.0) / linear_of(most / 255.0);
  EXPECT_NEAR(share, 0.25, 0.03);
}

TEST(EvenLight, ShowsABallInTwoLightsAlike) {
  const DepthScan one = even_light(ball(-0.4, 0.3, 0.2)), other = even_light(ball(0.3, 0.1, 0.4));
  // But for how bright the whole is.
  const double gain =
      linear_of(one.picture.pixels[at(40, 40)] / 255.0) / linear_of(other.picture.pixels[at(40, 40)] / 255.0);
  for (int y = 15; y < 65; ++y)
    for (int x = 15; x < 65; ++x)
      EXPECT_NEAR(one.picture.pixels[at(x, y)], 255 * srgb_of(gain * linear_of(other.picture.pixels[at(x, y)] / 255.0)),
                  6)
          << x << ' ' << y;
}

TEST(EvenLight, LeavesAScanWithoutDepthAsItIs) {
  DepthScan scan = ball(0, 0, 0.2);
  std::fill(scan.depth_mm.begin(), scan.depth_mm.end(), 0.0f);
  EXPECT_EQ(even_light(scan).picture.pixels, scan.picture.pixels);
  scan.depth_mm.pop_back();
  EXPECT_THROW_TEXT(even_light(scan), "scan has 6399 depths, its picture is 80 x 80 pixels");
}

}  // namespace face::mask
