// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/split_stops.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "nodes/base/random.h"

namespace {

face::Phones stop_between(double start_s, double end_s, double duration_s, const std::string& before = "AA") {
  face::Phones phones;
  phones.duration_s = duration_s;
  phones.phones = {{before, 0, start_s, before == "SIL" ? "" : "a", 0},
                   {"P", start_s, end_s, "pa", -1},
                   {"AA", end_s, duration_s, "pa", 0}};
  return phones;
}

// Voiced, closed (quiet voicing goes on), then noise from the burst.
face::Audio burst_at(double closed_s, double burst_s, double duration_s) {
  face::Audio audio;
  audio.samples.resize(static_cast<std::size_t>(duration_s * 16000));
  face::Random random(3);
  for (std::size_t i = 0; i < audio.samples.size(); ++i) {
    const double t = static_cast<double>(i) / 16000;
    const double voice = std::sin(2 * std::numbers::pi * 120 * t) + 0.3 * std::sin(2 * std::numbers::pi * 1200 * t);
    audio.samples[i] = static_cast<float>(t < closed_s  ? 0.3 * voice
                                          : t < burst_s ? 0.05 * std::sin(2 * std::numbers::pi * 120 * t)
                                                        : 0.2 * random.normal());
  }
  return audio;
}

}  // namespace

TEST(SplitStops, PutsTheReleaseAtTheBurst) {
  const face::Audio audio = burst_at(0.2, 0.273, 0.4);
  const face::Phones split = face::speech::split_stops(stop_between(0.2, 0.3, 0.4), &audio);
  ASSERT_EQ(split.phones.size(), 4u);
  EXPECT_EQ(split.phones[1].label, "P.c");
  EXPECT_EQ(split.phones[2].label, "P.r");
  EXPECT_NEAR(split.phones[1].end_s, 0.273, 0.002);  // two steps of the search
  EXPECT_EQ(split.phones[1].end_s, split.phones[2].start_s);
  EXPECT_EQ(split.phones[2].word, "pa");
  EXPECT_EQ(split.phones[1].score, -1);
}

TEST(SplitStops, IsUnchangedByGain) {
  face::Audio audio = burst_at(0.2, 0.273, 0.4);
  const double burst_s = face::speech::split_stops(stop_between(0.2, 0.3, 0.4), &audio).phones[1].end_s;
  for (float& s : audio.samples) s *= 0.1F;
  EXPECT_NEAR(face::speech::split_stops(stop_between(0.2, 0.3, 0.4), &audio).phones[1].end_s, burst_s, 0.0011);
}

TEST(SplitStops, TakesSixtyPercentWithoutAudio) {
  const face::Phones split = face::speech::split_stops(stop_between(0.2, 0.3, 0.4), nullptr);
  EXPECT_NEAR(split.phones[1].end_s, 0.26, 1e-12);
}

TEST(SplitStops, LeavesALongClosuresRestToThePauseBeforeIt) {
  const face::Audio audio = burst_at(0.1, 0.45, 0.6);
  const face::Phones split = face::speech::split_stops(stop_between(0.1, 0.5, 0.6, "SIL"), &audio);
  EXPECT_NEAR(split.phones[0].end_s, 0.30, 0.003);
  EXPECT_NEAR(split.phones[1].end_s - split.phones[1].start_s, 0.150, 1e-9);
  EXPECT_EQ(split.phones[0].end_s, split.phones[1].start_s);
}

TEST(SplitStops, SplitsNothingTwice) {
  const face::Phones once = face::speech::split_stops(stop_between(0.2, 0.3, 0.4), nullptr);
  const face::Phones twice = face::speech::split_stops(once, nullptr);
  ASSERT_EQ(twice.phones.size(), once.phones.size());
  for (std::size_t i = 0; i < once.phones.size(); ++i) EXPECT_EQ(twice.phones[i].label, once.phones[i].label);
}

TEST(SplitStops, SplitsASegmentTooShortToLookInto) {
  const face::Audio audio = burst_at(0.2, 0.205, 0.4);
  const face::Phones split = face::speech::split_stops(stop_between(0.2, 0.21, 0.4), &audio);
  ASSERT_EQ(split.phones.size(), 4u);
  EXPECT_NEAR(split.phones[1].end_s, 0.206, 1e-12);
}
