// SPDX-License-Identifier: Apache-2.0
// Real lips against marks that were made by hand before the tracker was tuned (tests/data/grid_marks/README.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "nodes/decode/read_audio.h"
#include "nodes/speech/align.h"
#include "tests/nodes/track/grid_clip.h"
#include "tests/support/data.h"

using namespace face;

namespace {

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const double high = values[std::min(low + 1, values.size() - 1)];
  return values[low] + (at - static_cast<double>(low)) * (high - values[low]);
}

constexpr double rate_hz = 25;

// Whether a frame shows any of [start_s, end_s).
bool overlaps(std::size_t frame, double start_s, double end_s) {
  return (static_cast<double>(frame) + 1) / rate_hz > start_s && static_cast<double>(frame) / rate_hz < end_s;
}

}  // namespace

TEST(TrackMarks, LipsAreWithinTwoPixelsOfTheMarksAndClosedAtTheBilabials) {
  const std::string models = "/usr/share/pocketsphinx/model/en-us/";
  std::vector<double> all;
  for (const std::string clip : test::grid_clips) {
    DATA_FILE(video, "grid/" + clip + ".mpg");
    DATA_FILE(start, "grid/" + clip + ".landmarks.json");
    DATA_FILE(sentence, "grid/" + clip + ".txt");
    const test::Tracked tracked = test::track_clip(video, start);
    std::vector<double> errors;
    for (const auto& [frame, marks] : test::read_marks(clip))
      for (const auto& [name, xy] : marks) {
        const Landmark& point = test::point_of(tracked.frames[frame].landmarks, name);
        errors.push_back(std::hypot(point.x_px - xy[0], point.y_px - xy[1]));
      }
    ASSERT_EQ(errors.size(), 24u);
    all.insert(all.end(), errors.begin(), errors.end());
    std::printf("%s: median %.2f px, p95 %.2f px", clip.c_str(), percentile(errors, 0.5), percentile(errors, 0.95));

    engine::Progress progress;
    std::ifstream file(sentence);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    const auto aligned =
        speech::align(decode::read_audio(engine::File::at(video)).audio, &text, engine::File::at(models + "en-us"),
                      engine::File::at(models + "cmudict-en-us.dict"), nullptr, {}, progress);
    const auto& segments = aligned.phones.phones;
    double spoken_from = 1e9, spoken_to = 0;
    for (const auto& segment : segments)
      if (segment.label != "SIL")
        spoken_from = std::min(spoken_from, segment.start_s), spoken_to = std::max(spoken_to, segment.end_s);
    std::vector<double> heights, spoken;
    for (std::size_t i = 0; i < tracked.frames.size(); ++i) {
      const auto& points = tracked.frames[i].landmarks;
      heights.push_back(test::point_of(points, "lip_9").y_px - test::point_of(points, "lip_3").y_px);
      if (overlaps(i, spoken_from, spoken_to)) spoken.push_back(heights.back());
    }
    // Of the frames in which somebody speaks: before and after, these mouths rest closed and thinner than any bilabial,
    // by the marks too (bbaf2n 13.5 and 14.5 px, lbax4n 14.5 and 18.5, lrwp9a 16.5 and 18).
    const double low = percentile(spoken, 0.25);
    std::printf(", 25th percentile %.1f px;", low);
    int bilabials = 0;
    for (const auto& segment : segments) {
      if (segment.label != "P.c" && segment.label != "B.c" && segment.label != "M") continue;
      double height = 1e9;
      for (std::size_t i = 0; i < heights.size(); ++i)
        if (overlaps(i, segment.start_s, segment.end_s)) height = std::min(height, heights[i]);
      std::printf(" %s at %.2f s %.1f px", segment.label.c_str(), segment.start_s, height);
      EXPECT_LT(height, low) << clip << ", " << segment.label << " at " << segment.start_s << " s";
      ++bilabials;
    }
    std::printf("\n");
    EXPECT_GT(bilabials, 0);
  }
  std::printf("all: median %.2f px, p95 %.2f px\n", percentile(all, 0.5), percentile(all, 0.95));
  EXPECT_LE(percentile(all, 0.5), 2);
  EXPECT_LE(percentile(all, 0.95), 4);
}
