// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak_kernel.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::trajectory;

PhoneStatistics speaker() {
  PhoneStatistics out;
  out.all = {"", 100, {0.25}, {1}};
  out.phones = {{"AA", 60, {1}, {1}}, {"P.c", 30, {0}, {1}}, {"P.r", 10, {0.8}, {1}}};
  return out;
}

std::vector<float> path(const Phones& phones, const SpeakKernelOptions& options = {}, Timeline* timeline = nullptr) {
  std::vector<float> out;
  engine::SeqWriter<Weights> writer([&](const std::string&, const Weights& w) { out.push_back(w.values[0]); });
  const Timeline made = speak_kernel(phones, speaker(), writer, options);
  if (timeline) *timeline = made;
  return out;
}

}  // namespace

TEST(SpeakKernel, AnswersAStepWithThePapersKernel) {
  // Slots 0 to 9 are P.c (0), 10 to 19 AA (1).
  const std::vector<float> a =
      path({{{"P.c", 0, 0.1, "", 0}, {"AA", 0.1, 0.2, "", 0}}, 0.2, true}, {.blur = Blur::none});
  ASSERT_EQ(a.size(), 20u);
  EXPECT_NEAR(a[6], 0, 1e-6);
  EXPECT_NEAR(a[7], 0.1, 1e-6);  // a_(i+3)
  EXPECT_NEAR(a[8], 0.1, 1e-6);
  EXPECT_NEAR(a[9], 0.1 + 0.3, 1e-6);  // and a_(i+1)
  EXPECT_NEAR(a[10], 0.9, 1e-6);       // all but a_(i-1)
  EXPECT_NEAR(a[11], 1, 1e-6);
}

TEST(SpeakKernel, BlursFourSlotsIntoAFrameOf25PerSecond) {
  const Phones phones{{{"P.c", 0, 0.1, "", 0}, {"AA", 0.1, 0.2, "", 0}}, 0.2, true};
  const std::vector<float> slots = path(phones, {.blur = Blur::none});
  Timeline timeline;
  const std::vector<float> frames = path(phones, {}, &timeline);
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_NEAR(frames[2], (slots[8] + slots[9] + slots[10] + slots[11]) / 4, 1e-6);
  EXPECT_NEAR(timeline.time_s[2], 0.08, 1e-12);
}

TEST(SpeakKernel, AveragesClosureAndReleaseAsThePaperDoes) {
  const Phones phones{{{"P.c", 0, 0.2, "", 0}}, 0.2, true};
  EXPECT_NEAR(path(phones)[2], 0, 1e-6);
  EXPECT_NEAR(path(phones, {.split_stops = false})[2], 0.2, 1e-6);  // (30 * 0 + 10 * 0.8) / 40: the lips stay open
}

TEST(SpeakKernel, TakesAllSpeechForAPhoneNeverSeen) {
  EXPECT_NEAR(path({{{"ZH", 0, 0.2, "", 0}}, 0.2, true})[1], 0.25, 1e-6);
}

TEST(SpeakKernel, MakesOneFrameOfNothing) { EXPECT_EQ(path({{}, 0, true}).size(), 1u); }

TEST(SpeakKernel, RejectsStatisticsWithoutParameters) {
  engine::SeqWriter<Weights> writer([](const std::string&, const Weights&) {});
  EXPECT_THROW_TEXT(speak_kernel({}, {}, writer), "statistics has no animation parameters");
}
