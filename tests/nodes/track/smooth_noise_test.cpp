// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/smooth_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/base/random.h"
#include "tests/nodes/track/grid_clip.h"
#include "tests/support/data.h"

using namespace face;

namespace {

void add_noise(Image& image, double deviation, std::uint64_t seed) {
  Random random(seed);
  for (std::uint8_t& value : image.pixels)
    value = static_cast<std::uint8_t>(std::lround(std::clamp(value + deviation * random.normal(), 0.0, 255.0)));
}

// A slope with edges every 8 pixels, grey.
Image stairs() {
  Image image{80, 60, 1, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.pixels.push_back(static_cast<std::uint8_t>(60 + x + 5 * (y / 8)));
  return image;
}

const Landmarks corners{{{"a", 15, 15, true}, {"b", 64, 44, true}}};

}  // namespace

TEST(SmoothNoise, MeasuresNoiseOverEdges) {
  Image image = stairs();
  EXPECT_LT(track::noise_level(image, corners), 0.5);
  add_noise(image, 6, 1);
  EXPECT_NEAR(track::noise_level(image, corners), 6, 0.4);  // of some 3,000 pixels
}

TEST(SmoothNoise, LeavesACleanPictureAlone) {
  Image image = stairs();
  add_noise(image, 1.5, 1);
  EXPECT_EQ(track::smooth_noise(image, corners).pixels, image.pixels);
}

TEST(SmoothNoise, TakesMostOfTheNoiseAway) {
  const Image clean = stairs();
  Image image = clean;
  add_noise(image, 10, 1);
  const Image smooth = track::smooth_noise(image, corners);
  double before = 0, after = 0;
  for (std::size_t i = 0; i < clean.pixels.size(); ++i) {
    before += std::pow(image.pixels[i] - clean.pixels[i], 2);
    after += std::pow(smooth.pixels[i] - clean.pixels[i], 2);
  }
  EXPECT_LT(after, 0.15 * before);
}

// What a camera shows by lamp light: eyes and chin were lost, and with them went the rest.
TEST(SmoothNoise, PointsOfANoisyFilmAreWhereTheyAreInTheCleanOne) {
  DATA_FILE(video, "grid/lbax4n.mpg");
  DATA_FILE(points, "grid/lbax4n.landmarks.json");
  auto frames = test::read_frames(video);
  frames.resize(40);
  const Landmarks start = decode::read_landmarks(engine::File::at(points)).landmarks;
  const auto clean = test::track_frames(frames, start);
  std::uint64_t seed = 1;
  for (auto& frame : frames) {
    Image noisy = *frame;
    add_noise(noisy, 10, seed++);
    frame = std::make_shared<const Image>(std::move(noisy));
  }
  const auto noisy = test::track_frames(frames, start);
  double squares = 0, count = 0, lost = 0;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (std::size_t k = 0; k < start.points.size(); ++k, ++count) {
      const Landmark &p = noisy[i].landmarks.points[k], &q = clean[i].landmarks.points[k];
      lost += !p.valid;
      squares += std::pow(p.x_px - q.x_px, 2) + std::pow(p.y_px - q.y_px, 2);
    }
  std::printf("%.2f px of the clean film, %.1f of 1000 lost\n", std::sqrt(squares / count), 1000 * lost / count);
  EXPECT_LE(std::sqrt(squares / count), 0.9);
  EXPECT_LE(lost / count, 0.04);
}
