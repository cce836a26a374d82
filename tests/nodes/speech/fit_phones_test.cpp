// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/fit_phones.h"

#include <gtest/gtest.h>

#include "nodes/speech/say.h"
#include "tests/nodes/speech/speech_material.h"
#include "tests/support/expect_throw_text.h"

namespace face::speech {
namespace {

SayResult spoken(const std::string& text) {
  engine::Progress progress;
  return say(text, nullptr, {Voice::slt}, progress);
}

FitPhonesResult fitted(const Audio& audio, const Phones& phones) {
  engine::Progress progress;
  return fit_phones(audio, phones, test::acoustic_model(), progress);
}

struct Summary {
  double mean_score = 0, median_apart_s = 0;
};

Summary summary(const FitPhonesResult& fit) {
  std::vector<double> apart;
  double sum = 0;
  for (std::size_t i = 0; i < fit.scored.phones.size(); ++i)
    if (fit.scored.phones[i].label != "SIL") sum += fit.scored.phones[i].score, apart.push_back(fit.apart_s.values[i]);
  std::sort(apart.begin(), apart.end());
  return {sum / static_cast<double>(apart.size()), apart[apart.size() / 2]};
}

const std::string text = "Peter Piper picked a peck of pickled peppers. Bob built a big blue boat by the bay.";

TEST(FitPhones, TheSpeakersOwnLabelsFit) {
  NEEDS_ACOUSTIC_MODEL();
  const SayResult said = spoken(text);
  const FitPhonesResult fit = fitted(said.audio, said.phones);
  ASSERT_EQ(fit.scored.phones.size(), said.phones.phones.size());
  ASSERT_EQ(fit.apart_s.rows, said.phones.phones.size());
  for (std::size_t i = 0; i < fit.scored.phones.size(); ++i) {
    EXPECT_EQ(fit.scored.phones[i].label, said.phones.phones[i].label);
    EXPECT_EQ(fit.scored.phones[i].start_s, said.phones.phones[i].start_s);
  }
  EXPECT_GT(summary(fit).mean_score, -3);
  EXPECT_LT(summary(fit).median_apart_s, 0.03);
}

TEST(FitPhones, ThoseOfOtherWordsDoNot) {
  NEEDS_ACOUSTIC_MODEL();
  const SayResult said = spoken(text);
  const SayResult other = spoken("Remember to wipe the lamp above the sofa. The vapor from the swamp may form a film.");
  EXPECT_LT(summary(fitted(said.audio, other.phones)).mean_score, -4.5);
}

TEST(FitPhones, SaysHowFarLabelsAreOffInTime) {
  NEEDS_ACOUSTIC_MODEL();
  const SayResult said = spoken(text);
  Phones late = said.phones;
  for (Phone& phone : late.phones) phone.start_s += 0.3, phone.end_s += 0.3;
  EXPECT_NEAR(summary(fitted(said.audio, late)).median_apart_s, 0.3, 0.04);
}

TEST(FitPhones, LabelsBeyondTheSoundFindNoRoom) {
  NEEDS_ACOUSTIC_MODEL();
  SayResult said = spoken(text);
  said.audio.samples.resize(2000);
  const FitPhonesResult fit = fitted(said.audio, said.phones);
  for (const Phone& phone : fit.scored.phones) EXPECT_EQ(phone.score, phone.label == "SIL" ? 0 : unplaced_score);
}

TEST(FitPhones, SilenceAloneAndNoLabelsAreNothingToFit) {
  NEEDS_ACOUSTIC_MODEL();
  const Audio audio{16000, std::vector<float>(16000, 0)};
  EXPECT_EQ(fitted(audio, Phones{}).apart_s.rows, 0u);
  EXPECT_EQ(fitted(audio, {{{"SIL", 0, 1, "", -3}}, 1, true}).scored.phones[0].score, 0);
}

TEST(FitPhones, RejectsWhatIsNoPhoneAndWhatIsNoSound) {
  const Audio audio{16000, std::vector<float>(16000, 0)};
  engine::Progress progress;
  EXPECT_THROW_TEXT(fit_phones(audio, {{{"QQ", 0, 1, "", 0}}, 1, true}, {}, progress),
                    "phone 0 is \"QQ\", expected SIL or one of the 39 of the CMU dictionary");
  EXPECT_THROW_TEXT(fit_phones({}, {}, {}, progress), "the audio is empty: no label fits it");
  EXPECT_THROW_TEXT(fit_phones({44100, {0}}, {}, {}, progress), "the audio has 44100 Hz, expected 16000 Hz");
}

}  // namespace
}  // namespace face::speech
