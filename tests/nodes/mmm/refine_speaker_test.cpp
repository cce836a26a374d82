// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/refine_speaker.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/mmm/find_components.h"
#include "nodes/mmm/from_components.h"
#include "nodes/mmm/speak_path.h"
#include "nodes/mmm/to_components.h"
#include "nodes/trajectory/train_phones.h"
#include "tests/nodes/mmm/mouths.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

constexpr double rate_hz = 30;

// Open and shut in turn, shut for three frames only.
Phones speech(std::size_t syllables) {
  Phones phones;
  double at_s = 0;
  const auto add = [&](const char* label, double frames) {
    Phone phone;
    phone.label = label, phone.start_s = at_s, phone.end_s = at_s += frames / rate_hz;
    phones.phones.push_back(phone);
  };
  for (std::size_t i = 0; i < syllables; ++i) add("AA", i % 2 ? 6 : 8), add("M", 3);
  phones.duration_s = at_s;
  return phones;
}
// A mouth that takes a while to open, and one more number that does the opposite.
std::vector<Weights> performed(const Phones& phones, Timeline& timeline) {
  std::vector<Weights> frames;
  const auto count = static_cast<std::size_t>(std::lround(phones.duration_s * rate_hz));
  double open = 0;
  for (std::size_t t = 0, p = 0; t < count; ++t) {
    const double time_s = static_cast<double>(t) / rate_hz;
    while (phones.phones[p].end_s <= time_s) ++p;
    open = phones.phones[p].label == "M" ? 0 : open + 0.5 * (1 - open);
    frames.push_back({{static_cast<float>(open), static_cast<float>(-open)}});
    timeline.time_s.push_back(time_s);
  }
  timeline.duration_s = phones.duration_s;
  return frames;
}
double error(const PhoneStatistics& statistics, const Phones& phones, const std::vector<Weights>& truth, bool hold) {
  double squares = 0;
  std::size_t t = 0;
  engine::SeqWriter<Weights> writer([&](std::string, const Weights& frame) {
    for (std::size_t k = 0; k < 2; ++k) squares += std::pow(frame.values[k] - truth[t].values[k], 2);
    ++t;
  });
  speak_path(phones, statistics, writer, {.smoothness = 10, .hold_closures = hold});
  return std::sqrt(squares / static_cast<double>(2 * t));
}

TEST(RefineSpeaker, BringsTheSpokenPathNearTheFrames) {
  for (const bool hold : {false, true}) {
    Timeline timeline;
    const Phones phones = speech(20);
    const std::vector<Weights> frames = performed(phones, timeline);
    const PhoneStatistics plain = trajectory::train_phones(frames, timeline, phones);
    RefineSpeakerOptions options;
    options.smoothness = 10;
    options.hold_closures = hold;
    const double share = hold ? 0.85 : 0.75;  // lips that are held shut are right with plain means too
    const PhoneStatistics refined = refine_speaker(frames, timeline, phones, plain, options);
    EXPECT_LT(error(refined, phones, frames, hold), share * error(plain, phones, frames, hold)) << hold;
    // Of another sentence, too.
    Timeline other;
    const Phones unseen = speech(7);
    const std::vector<Weights> truth = performed(unseen, other);
    EXPECT_LT(error(refined, unseen, truth, hold), share * error(plain, unseen, truth, hold)) << hold;
    EXPECT_EQ(refined.phones[0].covariance, plain.phones[0].covariance);
  }
}

TEST(RefineSpeaker, FindsTheMeansOfASpeakerWhoSpeaksAsItDoes) {
  PhoneStatistics speaker;
  speaker.all = {"", 100, {0.5, 0}, {1, 0, 0, 1}};
  speaker.phones = {{"AA", 50, {1.2, -0.4}, {0.1, 0, 0, 0.2}}, {"M", 50, {-0.3, 0.7}, {0.05, 0, 0, 0.4}}};
  for (const bool hold : {false, true}) {
    const Phones phones = speech(20);
    std::vector<Weights> frames;
    engine::SeqWriter<Weights> writer([&](std::string, const Weights& frame) { frames.push_back(frame); });
    const Timeline timeline = speak_path(phones, speaker, writer, {.hold_closures = hold});
    PhoneStatistics plain = speaker;
    for (PhoneStatistic& phone : plain.phones) phone.mean = {0.3, 0.1};
    RefineSpeakerOptions options;
    options.hold_closures = hold;
    options.restraint = 1e-3;
    const PhoneStatistics refined = refine_speaker(frames, timeline, phones, plain, options);
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t d = 0; d < 2; ++d)
        EXPECT_NEAR(refined.phones[k].mean[d], speaker.phones[k].mean[d], 1e-3) << k << d << hold;
  }
}

TEST(RefineSpeaker, AStrongRestraintLeavesThePlainMeans) {
  Timeline timeline;
  const Phones phones = speech(6);
  const std::vector<Weights> frames = performed(phones, timeline);
  const PhoneStatistics plain = trajectory::train_phones(frames, timeline, phones);
  RefineSpeakerOptions options;
  options.restraint = 1e6;
  const PhoneStatistics refined = refine_speaker(frames, timeline, phones, plain, options);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(refined.phones[k].mean[0], plain.phones[k].mean[0], 1e-4);
}

TEST(RefineSpeaker, SilenceBeforeAndAfterSpeechIsNotThatOfAPause) {
  // At rest (0) at both ends, half open in pauses.
  Timeline timeline;
  Phones phones;
  std::vector<Weights> frames;
  const auto add = [&](const char* label, int count, float open) {
    Phone phone;
    phone.label = label, phone.start_s = phones.duration_s, phone.end_s = phones.duration_s += count / rate_hz;
    phones.phones.push_back(phone);
    for (int i = 0; i < count; ++i) {
      timeline.time_s.push_back(static_cast<double>(frames.size()) / rate_hz);
      frames.push_back({{open}});
    }
  };
  add("SIL", 10, 0);
  for (int i = 0; i < 4; ++i) add("AA", 8, 1), add("SIL", 8, 0.5f);
  add("AA", 8, 1), add("SIL", 10, 0);
  timeline.duration_s = phones.duration_s;
  const PhoneStatistics refined =
      refine_speaker(frames, timeline, phones, trajectory::train_phones(frames, timeline, phones));
  std::vector<float> spoken;
  engine::SeqWriter<Weights> writer([&](std::string, const Weights& frame) { spoken.push_back(frame.values[0]); });
  speak_path(phones, refined, writer);
  EXPECT_NEAR(spoken.front(), 0, 0.1);
  EXPECT_NEAR(spoken.back(), 0, 0.1);
  EXPECT_NEAR(spoken[10 + 8 + 4], 0.5, 0.1);
}

TEST(RefineSpeaker, LeavesOutFramesThatWereLost) {
  Timeline timeline;
  const Phones phones = speech(6);
  std::vector<Weights> frames = performed(phones, timeline);
  const PhoneStatistics plain = trajectory::train_phones(frames, timeline, phones);
  frames[5].values.clear();
  const PhoneStatistics refined = refine_speaker(frames, timeline, phones, plain);
  EXPECT_TRUE(std::isfinite(refined.phones[0].mean[0]));
  EXPECT_THROW_TEXT(refine_speaker(std::vector<Weights>(3), timeline, phones, plain),
                    "there are 3 frames of weights and 60 times, expected as many");
  EXPECT_THROW_TEXT(refine_speaker(frames, timeline, Phones{}, plain), "there are no phones");
}

Mmm model() {
  Mmm made;
  for (int i = 0; i < 3; ++i) {
    MmmPrototype prototype{std::to_string(i), test::painted_mouth(0.3 * i, 1), {}};
    prototype.flow_64th_px.assign(2 * 96 * 64, 0);
    for (std::size_t p = 0; p < prototype.flow_64th_px.size(); p += 2)
      prototype.flow_64th_px[p + 1] = static_cast<std::int16_t>(64 * i * (p > 6000 ? 1 : 0));
    made.prototypes.push_back(std::move(prototype));
  }
  return made;
}
// Parameters that vary in two ways.
std::vector<Weights> varied() {
  std::vector<Weights> frames;
  for (int t = 0; t < 40; ++t) {
    const auto a = static_cast<float>(std::sin(0.7 * t)), b = static_cast<float>(std::cos(1.9 * t));
    frames.push_back({{0, 0.2f * a, 0.5f * a + 0.1f * b, 0.3f - 0.1f * b, 0.3f + 0.2f * b, 0.4f - 0.1f * b}});
  }
  frames.push_back({});
  return frames;
}

TEST(Components, AreUncorrelatedNumbersOfVarianceOne) {
  const Matrix components = find_components(model(), varied());
  ASSERT_EQ(component_count(components), 2u);
  double sum[2] = {0, 0}, squares[3] = {0, 0, 0};
  for (const Weights& frame : varied()) {
    const Weights numbers = to_components(components, frame);
    if (frame.values.empty()) {
      EXPECT_TRUE(numbers.values.empty());
      continue;
    }
    const double x = numbers.values.at(0), y = numbers.values.at(1);
    sum[0] += x, sum[1] += y, squares[0] += x * x, squares[1] += y * y, squares[2] += x * y;
  }
  EXPECT_NEAR(sum[0] / 40, 0, 1e-5);
  EXPECT_NEAR(squares[0] / 40, 1, 1e-4);
  EXPECT_NEAR(squares[1] / 40, 1, 1e-4);
  EXPECT_NEAR(squares[2] / 40, 0, 1e-4);
}

TEST(Components, GiveTheParametersBack) {
  const Matrix components = find_components(model(), varied());
  for (const Weights& frame : varied()) {
    const Weights back = from_components(components, to_components(components, frame));
    ASSERT_EQ(back.values.size(), frame.values.size());
    for (std::size_t i = 0; i < frame.values.size(); ++i) EXPECT_NEAR(back.values[i], frame.values[i], 1e-4);
  }
}

TEST(Components, RejectWhatDoesNotFit) {
  const Matrix components = find_components(model(), varied());
  EXPECT_THROW_TEXT(to_components(components, {{1, 2}}), "there are 2 parameters, the components are of 6");
  EXPECT_THROW_TEXT(from_components(components, {{1}}), "there are 1 numbers, expected 2");
  EXPECT_THROW_TEXT(find_components(model(), std::vector<Weights>(2)), "no frame has parameters");
  EXPECT_THROW_TEXT(component_count(Matrix{2, 1, {0, 0}}),
                    "components are 2 x 1 with 2 values, expected an odd number of rows");
}

}  // namespace
}  // namespace face::mmm
