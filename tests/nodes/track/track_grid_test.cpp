// SPDX-License-Identifier: Apache-2.0
// The six clips of the real material, from the film to the points.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/nodes/track/grid_clip.h"
#include "tests/support/data.h"

using namespace face;

namespace {

double distance_px(const Landmarks& points, std::size_t a, std::size_t b) {
  return std::hypot(points.points[a].x_px - points.points[b].x_px, points.points[a].y_px - points.points[b].y_px);
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

INSTANTIATE_TEST_SUITE_P(Clips, TrackGrid, testing::Values("bbaf2n", "brbk7n", "lbax4n", "lrwp9a", "pwij3p", "swwp2s"),
                         [](const auto& clip) { return std::string(clip.param); });
