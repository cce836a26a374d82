// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/lay_over.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/nodes/model/material.h"

using namespace face;
using namespace face::texture;

namespace {

// What is drawn is sharper than a film: teeth stood on the lips as a hard line.
TEST(LayOver, MakesTheMouthAsUnsharpAsThePicture) {
  constexpr int side = 128;
  const double sigma = 1.2;
  const auto edge = [&](double x_px) { return 0.5 * (1 + std::erf(x_px / (sigma * std::sqrt(2.0)))); };
  Image picture = test::blank(side, side, 100), mask = picture;
  for (int y = 0; y < side; ++y)  // a band of skin beside the mouth, as sharp as the camera is
    for (int x = 0; x < side; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        picture.pixels[static_cast<std::size_t>(3 * (y * side + x)) + c] =
            static_cast<std::uint8_t>(std::lround(100 + 60 * edge(24.5 - x)));
  mask.channels = 1;
  mask.pixels.assign(side * side, 255);
  FaceLayer layer;
  layer.width = layer.height = side;
  layer.colour.assign(side * side, Vec3f{0, 0, 0});
  layer.mouth_colour = layer.colour;
  layer.mouth.assign(side * side, 0.0f);
  layer.cover.assign(side * side, 1.0f);
  layer.alpha.assign(side * side, 0.0f);
  layer.shift_px.assign(side * side, Vec2f{0, 0});
  for (std::size_t i = 0; i < layer.alpha.size(); ++i) {
    const std::size_t x = i % side;
    layer.alpha[i] = 1;
    layer.colour[i] = {picture.pixels[3 * i] / 255.0f, picture.pixels[3 * i] / 255.0f, picture.pixels[3 * i] / 255.0f};
    if (x < 80) continue;
    layer.mouth[i] = 1;
    layer.colour[i] = layer.mouth_colour[i] = {0.8f, 0.8f, 0.8f};
  }
  const Image result = lay_over(layer, picture, picture, mask, 1);
  for (int x = 40; x < 120; ++x)
    EXPECT_NEAR(result.pixels[static_cast<std::size_t>(3 * (64 * side + x))], 100 + 104 * edge(x - 79.5), 9)
        << x;  // 8 % of the step: the estimate is one of a few edges
  for (int x = 0; x < 40; ++x)
    EXPECT_EQ(result.pixels[static_cast<std::size_t>(3 * (64 * side + x))],
              picture.pixels[static_cast<std::size_t>(3 * (64 * side + x))]);
}

}  // namespace
