// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/add_idle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "nodes/types/arkit.h"
#include "tests/support/expect_throw_text.h"

namespace face::trajectory {
namespace {

std::vector<Weights> idle(std::size_t frames, const AddIdleOptions& options = {}, float jaw = 0) {
  std::vector<Weights> still(frames, Weights{std::vector<float>(arkit_count, 0.0f)});
  Timeline timeline;
  for (std::size_t i = 0; i < frames; ++i) {
    still[i].values[arkit_index("jawOpen")] = jaw;
    timeline.time_s.push_back(static_cast<double>(i) / 60);
  }
  timeline.duration_s = static_cast<double>(frames) / 60;
  std::vector<Weights> out;
  engine::SeqWriter<Weights> writer([&](std::string, Weights value) { out.push_back(std::move(value)); });
  add_idle(engine::Seq<Weights>(still), timeline, writer, options);
  return out;
}

std::vector<double> blink_times(const std::vector<Weights>& frames) {
  std::vector<double> times;
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (frames[i].values[0] > 0 && frames[i - 1].values[0] == 0) times.push_back(static_cast<double>(i) / 60);
  return times;
}

TEST(AddIdle, BlinksEveryTwoToFiveSeconds) {
  const std::vector<double> times = blink_times(idle(60 * 60));
  ASSERT_GE(times.size(), 12u);
  for (std::size_t i = 1; i < times.size(); ++i) {
    EXPECT_GT(times[i] - times[i - 1], 2 - 0.02);
    EXPECT_LT(times[i] - times[i - 1], 5 + 0.02);
  }
}

TEST(AddIdle, ClosesTheLidsAndMovesNothingByMoreThanAQuarterPerFrame) {
  const std::vector<Weights> frames = idle(60 * 60);
  float most = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    most = std::max(most, frames[i].values[arkit_index("eyeBlinkLeft")]);
    for (std::size_t s = 0; s < arkit_count; ++s) {
      EXPECT_LE(std::abs(frames[i].values[s] - frames[i - 1].values[s]), 0.25f);
      EXPECT_TRUE(frames[i].values[s] >= 0 && frames[i].values[s] <= 1);
    }
  }
  EXPECT_EQ(most, 1.0f);
}

TEST(AddIdle, LeavesTheMouthAlone) {
  const std::vector<Weights> frames = idle(600, {}, 0.25f);
  ASSERT_EQ(frames.size(), 600u);
  for (const Weights& frame : frames)
    for (std::size_t s = 0; s < arkit_count; ++s) {
      const bool speaks = arkit_names[s].starts_with("mouth") || arkit_names[s].starts_with("jaw");
      if (speaks) {
        EXPECT_EQ(frame.values[s], arkit_names[s] == "jawOpen" ? 0.25f : 0.0f);
      }
    }
}

TEST(AddIdle, IsTheSameForTheSameSeedAndAnotherForAnother) {
  EXPECT_EQ(blink_times(idle(1200)), blink_times(idle(1200)));
  EXPECT_NE(blink_times(idle(1200)), blink_times(idle(1200, {.seed = 2})));
}

TEST(AddIdle, ALongerTakeBeginsTheSame) {
  const std::vector<Weights> shorter = idle(300), longer = idle(900);
  ASSERT_EQ(shorter.size(), 300u);
  ASSERT_EQ(longer.size(), 900u);
  for (std::size_t i = 0; i < shorter.size(); ++i) EXPECT_EQ(shorter[i].values, longer[i].values);
}

TEST(AddIdle, OfNothingIsNothing) { EXPECT_TRUE(idle(0).empty()); }

TEST(AddIdle, RejectsATimelineOfOtherLength) {
  engine::SeqWriter<Weights> writer([](std::string, Weights) {});
  EXPECT_THROW_TEXT(add_idle(engine::Seq<Weights>(), Timeline{{0.0}, 1.0}, writer),
                    "there are 0 frames of weights and 1 in the timeline");
}

}  // namespace
}  // namespace face::trajectory
