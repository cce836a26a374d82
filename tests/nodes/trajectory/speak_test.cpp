// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "nodes/trajectory/read_visemes.h"
#include "nodes/types/arkit.h"
#include "tests/nodes/trajectory/judge_speech.h"
#include "tests/nodes/trajectory/simple_mouth.h"
#include "tests/support/expect_throw_text.h"

namespace face::trajectory {
namespace {

Visemes table() {
  return read_visemes(engine::File::at(std::string(FACEGRAPH_SOURCE_DIR) + "/graphs/speech/visemes.json"));
}

// Phones one after the other: {{"AA", 0.1}, ...}, lengths in s.
Phones string_of(const std::vector<std::pair<std::string, double>>& parts) {
  Phones phones;
  for (const auto& [label, length_s] : parts) {
    phones.phones.push_back({label, phones.duration_s, phones.duration_s + length_s, {}, 0});
    phones.duration_s += length_s;
  }
  return phones;
}

struct Spoken {
  std::vector<Weights> weights;
  SpeakResult result;
};

Spoken spoken(const Phones& phones, const Rig& rig = test::simple_mouth(), const SpeakOptions& options = {}) {
  Spoken out;
  engine::SeqWriter<Weights> writer([&](std::string, Weights value) { out.weights.push_back(std::move(value)); });
  out.result = speak(phones, table(), rig, writer, options);
  return out;
}

const std::vector<std::pair<std::string, double>> papa = {
    {"SIL", 0.2}, {"P.c", 0.06}, {"P.r", 0.03}, {"AA", 0.15}, {"P.c", 0.07}, {"P.r", 0.02}, {"AA", 0.16},
    {"M", 0.07},  {"AA", 0.12},  {"M", 0.05},   {"AE", 0.1},  {"F", 0.09},   {"AA", 0.1},   {"V", 0.05},
    {"OW", 0.2},  {"B.c", 0.05}, {"B.r", 0.01}, {"IY", 0.1},  {"SIL", 0.3}};

TEST(Speak, GivesOneFrameOf52WeightsPerTickWithinZeroAndOne) {
  const Spoken out = spoken(string_of(papa));
  EXPECT_EQ(out.weights.size(), 116u);  // 1.93 s at 60 Hz: 115.8
  EXPECT_EQ(out.result.timeline.time_s.size(), 116u);
  EXPECT_DOUBLE_EQ(out.result.timeline.time_s[60], 1.0);
  for (const Weights& frame : out.weights) {
    ASSERT_EQ(frame.values.size(), arkit_count);
    for (const float value : frame.values) EXPECT_TRUE(value >= 0 && value <= 1);
  }
}

TEST(Speak, MeetsEveryContactAtEveryRate) {
  const Phones phones = string_of(papa);
  const Rig rig = test::simple_mouth();
  for (const double rate_hz : {25.0, 30.0, 48.0, 60.0, 120.0}) {
    const Spoken out = spoken(phones, rig, {.rate_hz = rate_hz});
    EXPECT_EQ(out.result.missed_count, 0) << rate_hz;
    const test::Verdict verdict = test::judge_speech(phones, out.weights, out.result.timeline, rig);
    EXPECT_EQ(verdict.bilabials, 5) << rate_hz;
    EXPECT_LE(verdict.widest_closure_mm, 1.0) << rate_hz;
    EXPECT_GE(verdict.deepest_gap_mm, -0.3) << rate_hz;
    EXPECT_GE(verdict.least_open_mm, 1.5) << rate_hz;
  }
}

TEST(Speak, ClosesForAPhoneShorterThanAFrame) {
  const Phones phones =
      string_of({{"SIL", 0.1}, {"AA", 0.1043}, {"P.c", 0.004}, {"P.r", 0.006}, {"AA", 0.1}, {"SIL", 0.1}});
  const Spoken out = spoken(phones);
  EXPECT_EQ(out.result.contact_count, 3);
  EXPECT_EQ(out.result.missed_count, 0);
  EXPECT_LE(out.result.worst_closure_mm, 0.3);
}

TEST(Speak, ReportsWhatItMeasures) {
  const Phones phones = string_of(papa);
  const Rig rig = test::simple_mouth();
  const Spoken out = spoken(phones, rig);
  const test::Verdict verdict = test::judge_speech(phones, out.weights, out.result.timeline, rig);
  EXPECT_NEAR(out.result.worst_closure_mm, verdict.widest_closure_mm, 1e-3);
  EXPECT_EQ(out.result.contact_count, 13);
}

TEST(Speak, AClosedMouthStaysClosedInSilence) {
  const Spoken out = spoken(string_of({{"SIL", 1.0}}));
  for (const Weights& frame : out.weights)
    for (const char* name : {"jawOpen", "mouthClose", "mouthFunnel", "mouthLowerDownLeft"})
      EXPECT_EQ(frame.values[arkit_index(name)], 0.0f) << name;
}

TEST(Speak, ChangingOneWordLeavesFarFramesAsTheyAreToTheBit) {
  std::vector<std::pair<std::string, double>> parts;
  for (int i = 0; i < 4; ++i) parts.insert(parts.end(), papa.begin(), papa.end());
  const Phones before = string_of(parts);
  parts[22].first = "UW";  // one vowel, early in the second repetition: from 2.22 to 2.37 s
  const Phones after = string_of(parts);
  const Spoken a = spoken(before), b = spoken(after);
  ASSERT_EQ(a.weights.size(), b.weights.size());
  std::size_t first = a.weights.size(), last = 0;
  for (std::size_t i = 0; i < a.weights.size(); ++i)
    if (a.weights[i].values != b.weights[i].values) first = std::min(first, i), last = std::max(last, i);
  EXPECT_GT(first, static_cast<std::size_t>((2.22 - 0.6) * 60));
  EXPECT_LT(last, static_cast<std::size_t>((2.37 + 0.6) * 60));
}

TEST(Speak, MoreStrengthOpensWider) {
  const Phones phones = string_of({{"SIL", 0.2}, {"AA", 0.4}, {"SIL", 0.2}});
  const std::size_t jaw = arkit_index("jawOpen");
  const auto widest = [&](double strength) {
    float most = 0;
    for (const Weights& frame : spoken(phones, test::simple_mouth(), {.strength = strength}).weights)
      most = std::max(most, frame.values[jaw]);
    return most;
  };
  EXPECT_GT(widest(1.2), widest(1.0) * 1.15f);
  EXPECT_GT(widest(0.4), 0.1f);
}

TEST(Speak, ShortPhonesAreReachedBetterWhenNormalisedByDuration) {
  const Phones phones = string_of({{"SIL", 0.2}, {"UW", 0.04}, {"SIL", 0.2}});
  const auto pucker = [&](Normalise normalise) {
    float most = 0;
    for (const Weights& frame : spoken(phones, test::simple_mouth(), {.normalise = normalise}).weights)
      most = std::max(most, frame.values[arkit_index("mouthPucker")]);
    return most;
  };
  EXPECT_GT(pucker(Normalise::duration), pucker(Normalise::none) * 1.1f);
  EXPECT_NEAR(pucker(Normalise::utterance), pucker(Normalise::none), 0.05);
}

TEST(Speak, ARigWithoutTeethIsReportedNotRefused) {
  Rig rig = test::simple_mouth();
  rig.upper_teeth.clear();
  const Spoken out = spoken(string_of(papa), rig);
  EXPECT_EQ(out.result.missed_count, 2);  // F and V
  EXPECT_LE(out.result.worst_closure_mm, 0.3);
}

TEST(Speak, ARigThatLacksShapesStillCloses) {
  Rig rig = test::simple_mouth();
  for (const char* name :
       {"mouthPressLeft", "mouthPressRight", "mouthShrugLower", "mouthUpperUpLeft", "mouthUpperUpRight"})
    rig.shapes[arkit_index(name)] = {name, {}, {}};
  EXPECT_LE(spoken(string_of(papa), rig).result.worst_closure_mm, 0.3);
}

TEST(Speak, OfNothingIsOneFrame) {
  EXPECT_EQ(spoken(Phones{}).weights.size(), 1u);
  EXPECT_EQ(spoken(string_of({{"SIL", 0.001}})).weights.size(), 1u);
}

TEST(Speak, RejectsPhonesOutOfOrder) {
  Phones phones = string_of({{"AA", 0.2}, {"IY", 0.2}});
  phones.phones[1].start_s = 0.1;
  EXPECT_THROW_TEXT(spoken(phones), "phone 1 (IY) runs from 0.1 to 0.4 s, expected phones in order, after 0.2 s");
}

TEST(Speak, RejectsAPhoneThatTheTableLacks) {
  EXPECT_THROW_TEXT(spoken(string_of({{"AA", 0.2}, {"QQ", 0.2}})),
                    "phone 1 is \"QQ\", which the viseme table does not have");
}

TEST(Speak, RejectsARigThatIsNotArkit) {
  EXPECT_THROW_TEXT(spoken(string_of(papa), Rig{}), "the rig has 0 shapes, expected the 52 of ARKit first");
}

}  // namespace
}  // namespace face::trajectory
