// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/face_contrast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/base/find_landmark.h"
#include "tests/nodes/track/phantom_clip.h"

namespace {

using namespace face;
using track::face_contrast;

const Image& picture() { return *test::resting_speaker().frames[0]; }
const Landmarks& points() { return test::resting_speaker().truth[0]; }

// Every value, with the place across the picture, 0 to 1.
template <class Function>
Image changed(Image image, const Function& value_of) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double x = static_cast<double>(i / 3 % static_cast<std::size_t>(image.width)) / image.width;
    image.pixels[i] = static_cast<std::uint8_t>(std::clamp(value_of(image.pixels[i], x) + 0.5, 0.0, 255.0));
  }
  return image;
}

// What whole grey values make of the phantom's smooth skin.
constexpr double rounding = 0.03;

}  // namespace

TEST(FaceContrast, IsThatOfTheGrading) {
  const auto plain = face_contrast(picture(), points());
  const auto flat = face_contrast(changed(picture(), [](double v, double) { return 0.4 * v + 100; }), points());
  const double light = (plain[2] - flat[2]) / plain[2];  // of 0.4 v + 100 the share that is the picture's
  EXPECT_GT(light, 0.6);
  for (const std::size_t c : {0u, 2u}) {
    EXPECT_LT(flat[c], 0.45 * plain[c]) << c;
    EXPECT_GT(flat[c], 0.15 * plain[c]) << c;
  }
}

TEST(FaceContrast, IsTheSameInHalfTheLight) {
  const auto plain = face_contrast(picture(), points());
  const auto dim = face_contrast(changed(picture(), [](double v, double) { return 0.6 * v; }), points());
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(dim[c] / plain[c], 1, 0.1) << c;
}

TEST(FaceContrast, DoesNotComeFromALightOnOneSide) {
  const auto plain = face_contrast(picture(), points());
  const auto side = face_contrast(changed(picture(), [](double v, double x) { return v * (0.5 + x); }), points());
  EXPECT_NEAR(side[2] / plain[2], 1, 0.1);
}

TEST(FaceContrast, DoesNotSeeTheMouth) {
  const double upper_lip_px = find_landmark(points(), "lip_3")->y_px;
  Image gagged = picture();
  const auto from = static_cast<std::size_t>(upper_lip_px) * static_cast<std::size_t>(gagged.width) * 3;
  std::fill(gagged.pixels.begin() + static_cast<std::ptrdiff_t>(from), gagged.pixels.end(), std::uint8_t{0});
  EXPECT_EQ(face_contrast(gagged, points()), face_contrast(picture(), points()));
}

TEST(FaceContrast, IsTheSameInALargerPicture) {
  Image large{2 * picture().width, 2 * picture().height, 3, {}};
  for (int y = 0; y < large.height; ++y)
    for (int x = 0; x < large.width; ++x) {
      const auto at = picture().pixels.begin() + 3 * (static_cast<std::ptrdiff_t>(y / 2) * picture().width + x / 2);
      large.pixels.insert(large.pixels.end(), at, at + 3);
    }
  Landmarks twice = points();
  for (Landmark& p : twice.points) p.x_px = 2 * p.x_px + 0.5, p.y_px = 2 * p.y_px + 0.5;
  const auto plain = face_contrast(picture(), points()), larger = face_contrast(large, twice);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(larger[c] / plain[c], 1, 2 * rounding) << c;
}

TEST(FaceContrast, IsUsualWhereNobodyKnows) {
  constexpr std::array<double, 3> usual{1, 1, 1};
  Landmarks without = points();
  std::erase_if(without.points, [](const Landmark& p) { return p.name == "nose_tip"; });
  EXPECT_EQ(face_contrast(picture(), without), usual);
  Landmarks elsewhere = points();
  for (Landmark& p : elsewhere.points) p.x_px += 5000;
  EXPECT_EQ(face_contrast(picture(), elsewhere), usual);
  Landmarks one_place = points();
  for (Landmark& p : one_place.points) p.x_px = p.y_px = 50;
  EXPECT_EQ(face_contrast(picture(), one_place), usual);
}
