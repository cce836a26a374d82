// SPDX-License-Identifier: Apache-2.0
// The six clips of the real material, from the film to the points.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "tests/nodes/track/grid_clip.h"
#include "tests/support/data.h"

using namespace face;

namespace {

double distance_px(const Landmarks& points, std::size_t a, std::size_t b) {
  return std::hypot(points.points[a].x_px - points.points[b].x_px, points.points[a].y_px - points.points[b].y_px);
}

// Each pixel as a square of `times` x `times`.
std::shared_ptr<const Image> enlarged(const Image& image, int times) {
  Image large{times * image.width, times * image.height, image.channels, {}};
  for (int y = 0; y < large.height; ++y)
    for (int x = 0; x < large.width; ++x) {
      const auto from = image.pixels.begin() + (y / times * image.width + x / times) * image.channels;
      large.pixels.insert(large.pixels.end(), from, from + image.channels);
    }
  return std::make_shared<const Image>(std::move(large));
}

class TrackGrid : public testing::TestWithParam<const char*> {};

}  // namespace

TEST_P(TrackGrid, KeepsThePointsOnTheFaceThroughAllFrames) {
  DATA_FILE(video, std::string("grid/") + GetParam() + ".mpg");
  DATA_FILE(points, std::string("grid/") + GetParam() + ".landmarks.json");
  const test::Tracked tracked = test::track_clip(video, points);
  ASSERT_EQ(tracked.frames.size(), 75u);
  const std::size_t eye_r = 0, eye_l = 1, lip_0 = 3, lip_6 = 9;
  const double eyes = distance_px(tracked.start, eye_r, eye_l), mouth = distance_px(tracked.start, lip_0, lip_6);
  double lost = 0;
  for (const auto& frame : tracked.frames) {
    lost += frame.lost;
    const auto& p = frame.landmarks.points;
    if (p[eye_r].valid && p[eye_l].valid) {
      EXPECT_NEAR(distance_px(frame.landmarks, eye_r, eye_l), eyes, 3);  // the heads turn a little
    }
    if (p[lip_0].valid && p[lip_6].valid) {
      const double width = distance_px(frame.landmarks, lip_0, lip_6) / mouth;
      EXPECT_GT(width, 0.55);  // lbax4n puckers to 0.60
      EXPECT_LT(width, 1.3);   // grin
    }
    // The outline of the lips stays in order: upper lip points from left to right, and above the lower ones.
    for (std::size_t i = lip_0; i < lip_6; ++i)
      if (p[i].valid && p[i + 1].valid) {
        EXPECT_GT(p[i + 1].x_px, p[i].x_px) << p[i].name;
      }
    if (p[6].valid && p[12].valid) {
      EXPECT_GT(p[12].y_px, p[6].y_px + 2);  // lip_9 below lip_3
    }
  }
  EXPECT_LE(lost / (75 * 18), 0.04);  // measured: 0.004 to 0.030
}

// Cameras of today show a mouth of hundreds of pixels: patches of 15 px lost eyes and chin.
TEST(TrackCloseUp, PointsAreWhereTheyAreInThePictureAsItWas) {
  DATA_FILE(video, "grid/pwij3p.mpg");
  DATA_FILE(points, "grid/pwij3p.landmarks.json");
  constexpr int times = 3;
  auto frames = test::read_frames(video);
  frames.resize(45);
  Landmarks start = decode::read_landmarks(engine::File::at(points)).landmarks;
  const auto plain = test::track_frames(frames, start);
  for (auto& frame : frames) frame = enlarged(*frame, times);
  for (Landmark& point : start.points) {
    point.x_px = times * (point.x_px + 0.5) - 0.5;
    point.y_px = times * (point.y_px + 0.5) - 0.5;
  }
  const auto large = test::track_frames(frames, start);
  double squares = 0, count = 0, lost = 0;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (std::size_t k = 0; k < start.points.size(); ++k) {
      const Landmark &p = large[i].landmarks.points[k], &q = plain[i].landmarks.points[k];
      lost += !p.valid;
      squares +=
          std::pow((p.x_px + 0.5) / times - 0.5 - q.x_px, 2) + std::pow((p.y_px + 0.5) / times - 0.5 - q.y_px, 2);
      ++count;
    }
  std::printf("%.2f px of the plain picture, %.1f of 1000 lost\n", std::sqrt(squares / count), 1000 * lost / count);
  EXPECT_LE(std::sqrt(squares / count), 1);
  EXPECT_LE(lost / count, 0.04);
}

INSTANTIATE_TEST_SUITE_P(Clips, TrackGrid, testing::Values("bbaf2n", "brbk7n", "lbax4n", "lrwp9a", "pwij3p", "swwp2s"),
                         [](const auto& clip) { return std::string(clip.param); });
