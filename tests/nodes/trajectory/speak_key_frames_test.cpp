// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak_key_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/expect_throw_text.h"

namespace face::trajectory {
namespace {

Viseme viseme(const char* label, float open) {
  Viseme v;
  v.label = label;
  v.weights.assign(52, open);
  v.sigmas.assign(52, 0.4f);
  return v;
}

std::vector<float> said(const Phones& phones, const Visemes& visemes, double rate_hz) {
  std::vector<float> first;
  engine::SeqWriter<Weights> writer([&](const std::string&, const Weights& w) { first.push_back(w.values[0]); });
  const Timeline timeline = speak_key_frames(phones, visemes, writer, {.rate_hz = rate_hz});
  EXPECT_EQ(timeline.time_s.size(), first.size());
  EXPECT_EQ(timeline.duration_s, phones.duration_s);
  return first;
}

const Visemes table{{viseme("SIL", 0), viseme("AA", 1)}};
const Phones open_up{{{"SIL", 0, 0.2, "", 0}, {"AA", 0.2, 0.4, "", 0}}, 0.4, true};

TEST(SpeakKeyFrames, ReachesEveryVisemeAtTheMiddleOfItsPhone) {
  const std::vector<float> values = said(open_up, table, 20);  // 0, 50, 100, ... ms
  ASSERT_EQ(values.size(), 8u);
  EXPECT_FLOAT_EQ(values[2], 0);
  EXPECT_FLOAT_EQ(values[6], 1);
}

TEST(SpeakKeyFrames, GoesBetweenThemAsACosine) {
  const std::vector<float> values = said(open_up, table, 20);
  EXPECT_NEAR(values[3], 0.5 * (1 - std::sqrt(0.5)), 1e-6);  // a quarter of the way: (1 - cos 45 degrees) / 2
  EXPECT_NEAR(values[4], 0.5, 1e-6);
}

TEST(SpeakKeyFrames, RestsOnTheFirstAndTheLast) {
  const std::vector<float> values = said(open_up, table, 20);
  EXPECT_FLOAT_EQ(values[0], 0);
  EXPECT_FLOAT_EQ(values[7], 1);
}

TEST(SpeakKeyFrames, GivesADiphthongTwoKeyFrames) {
  Visemes glides = table;
  glides.visemes.push_back(viseme("AY", 1));
  glides.visemes.back().glide_weights.assign(52, 0.25f);
  glides.visemes.back().glide_from = 0.5;
  const std::vector<float> values = said({{{"AY", 0, 0.4, "", 0}}, 0.4, true}, glides, 20);
  EXPECT_FLOAT_EQ(values[2], 1);
  EXPECT_FLOAT_EQ(values[6], 0.25f);
}

TEST(SpeakKeyFrames, WantsPhones) {
  engine::SeqWriter<Weights> writer([](const std::string&, const Weights&) {});
  EXPECT_THROW_TEXT(speak_key_frames({}, table, writer), "there are no phones");
}

}  // namespace
}  // namespace face::trajectory
