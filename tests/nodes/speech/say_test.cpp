// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/say.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "nodes/speech/arpabet.h"
#include "tests/nodes/speech/speech_material.h"
#include "tests/support/expect_throw_text.h"

using face::speech::say;
using face::speech::SayResult;
using face::speech::Voice;

namespace {

SayResult spoken(const std::string& text, Voice voice = Voice::slt, double stretch = 1) {
  engine::Progress progress;
  return say(text, nullptr, {voice, stretch}, progress);
}

}  // namespace

TEST(Say, SpeaksTheWordsOfTheTextInEveryVoice) {
  for (const Voice voice : {Voice::slt, Voice::rms, Voice::awb, Voice::kal}) {
    const SayResult result = spoken("Pam's dog bit Bob.", voice);
    EXPECT_EQ(result.audio.rate_hz, 16000);
    EXPECT_GT(result.audio.duration_s(), 1.0);
    EXPECT_EQ(result.phones.duration_s, result.audio.duration_s());
    std::vector<std::string> words;
    for (const face::Phone& phone : result.phones.phones)
      if (!phone.word.empty() && (words.empty() || words.back() != phone.word)) words.push_back(phone.word);
    EXPECT_EQ(words, (std::vector<std::string>{"pam's", "dog", "bit", "bob"}));
  }
}

TEST(Say, TilesTheAudioWithPhonesOfTheSet) {
  const face::Phones phones = spoken("The quick brown fox jumps over the lazy dog, twice.").phones;
  double at_s = 0;
  for (const face::Phone& phone : phones.phones) {
    EXPECT_EQ(phone.start_s, at_s);
    EXPECT_GT(phone.end_s, phone.start_s);
    EXPECT_EQ(face::speech::arpabet_label(phone.label), phone.label);
    EXPECT_FALSE(face::speech::is_stop(phone.label));  // all are split
    at_s = phone.end_s;
  }
  EXPECT_EQ(at_s, phones.duration_s);
}

TEST(Say, IsLoudInVowelsAndQuietInPauses) {
  const SayResult result = spoken("Bob, my boy, moved a bomb.");
  double vowel = 0, pause = 0, vowel_s = 0, pause_s = 0;
  for (const face::Phone& phone : result.phones.phones) {
    double energy = 0;
    for (auto i = static_cast<std::size_t>(phone.start_s * 16000); i < static_cast<std::size_t>(phone.end_s * 16000);
         ++i)
      energy += double{result.audio.samples[i]} * result.audio.samples[i];
    const double length_s = phone.end_s - phone.start_s;
    if (phone.label == "AA" || phone.label == "AY" || phone.label == "OY" || phone.label == "UW")
      vowel += energy, vowel_s += length_s;
    if (phone.label == "SIL") pause += energy, pause_s += length_s;
  }
  EXPECT_GT(vowel / vowel_s, 100 * pause / pause_s);
}

TEST(Say, SpeaksSlowlyWhenStretched) {
  const double plain_s = spoken("My mother makes money.").audio.duration_s();
  const double slow_s = spoken("My mother makes money.", Voice::slt, 2).audio.duration_s();
  EXPECT_NEAR(slow_s / plain_s, 2, 0.1);
  EXPECT_EQ(spoken("My mother makes money.").audio.duration_s(), plain_s);  // nothing sticks to the voice
}

TEST(Say, GivesTheSameFromSeveralThreads) {
  const SayResult alone = spoken("Five very big boats.");
  std::vector<SayResult> results(4);
  std::vector<std::thread> threads;
  for (SayResult& result : results) threads.emplace_back([&result] { result = spoken("Five very big boats."); });
  for (std::thread& thread : threads) thread.join();
  for (const SayResult& result : results) EXPECT_EQ(result.audio.samples, alone.audio.samples);
}

TEST(Say, WarnsOfCharactersItLeavesOut) {
  test::Warnings warnings;
  say("Caf\u00e9 \u6f22", nullptr, {}, warnings);
  ASSERT_EQ(warnings.texts.size(), 1u);
  EXPECT_EQ(warnings.texts[0], "left out 1 character that cannot be read as English: \u6f22");
}

TEST(Say, TellsHowItSpokeWordsThatTheDictionaryLacks) {
  NEEDS_ACOUSTIC_MODEL();
  const engine::File dictionary = test::dictionary();
  test::Warnings warnings;
  say("Bob saw the flobbit's dog, Bob's flobbit, a flobbit, a blorft and 3 dogs.", &dictionary, {}, warnings);
  EXPECT_EQ(warnings.texts,
            (std::vector<std::string>{"\"flobbit's\" is not in the dictionary: spoken as F L AA B IH T S",
                                      "\"flobbit\" is not in the dictionary: spoken as F L AA B IH T",
                                      "\"blorft\" is not in the dictionary: spelled letter by letter"}));
  test::Warnings none;
  const SayResult with = say("Bob saw 21 dogs.", &dictionary, {}, none);
  EXPECT_EQ(none.texts, std::vector<std::string>());
  EXPECT_EQ(with.audio.samples, spoken("Bob saw 21 dogs.").audio.samples);
}

TEST(Say, RefusesATextWithNothingToSay) {
  EXPECT_THROW_TEXT(spoken(""), "nothing to say: the text \"\" has no letter and no digit");
  EXPECT_THROW_TEXT(spoken("?!"), "nothing to say: the text \"?!\" has no letter and no digit");
  EXPECT_THROW_TEXT(spoken("a", Voice::slt, 0), "duration_stretch is 0, expected more than 0");
}
