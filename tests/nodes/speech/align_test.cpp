// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/align.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "nodes/base/text_grid.h"
#include "nodes/speech/read_phones.h"
#include "nodes/speech/say.h"
#include "tests/nodes/speech/speech_material.h"
#include "tests/support/expect_throw_text.h"

using face::Audio;
using face::Phone;
using face::Phones;
using face::speech::AlignResult;
using face::speech::Voice;

namespace {

face::speech::SayResult spoken(const std::string& text, Voice voice = Voice::slt) {
  engine::Progress progress;
  return face::speech::say(text, nullptr, {voice}, progress);
}

AlignResult aligned(const Audio& audio, const std::string& text, engine::Progress&& progress = {}) {
  return face::speech::align(audio, &text, test::acoustic_model(), test::dictionary(), nullptr, {}, progress);
}

AlignResult recognised(const Audio& audio, const engine::File* phone_model) {
  engine::Progress progress;
  return face::speech::align(audio, nullptr, test::acoustic_model(), test::dictionary(), phone_model, {}, progress);
}

Audio silence(double length_s) {
  Audio audio;
  audio.samples.assign(static_cast<std::size_t>(length_s * 16000), 0.0F);
  return audio;
}

void expect_tiles(const Phones& phones, const Audio& audio) {
  ASSERT_FALSE(phones.phones.empty());
  double at_s = 0;
  for (const Phone& phone : phones.phones) {
    EXPECT_EQ(phone.start_s, at_s);
    EXPECT_GT(phone.end_s, phone.start_s) << phone.label;
    at_s = phone.end_s;
  }
  EXPECT_EQ(at_s, audio.duration_s());
  EXPECT_EQ(phones.duration_s, audio.duration_s());
}

// The largest shift of a boundary between two alignments of the same phones; infinite where the phones differ.
double largest_shift_s(const Phones& a, const Phones& b, double by_s = 0) {
  const auto left = test::whole_phones(a), right = test::whole_phones(b);
  if (left.size() != right.size()) return INFINITY;
  double largest = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    if (left[i].label != right[i].label) return INFINITY;
    if (i > 0) largest = std::max(largest, std::abs(left[i].start_s + by_s - right[i].start_s));
  }
  return largest;
}

const std::string sentence = "Bob and Pam built a very big boat for my mother.";

}  // namespace

TEST(Align, PlacesTheWordsOfTheTranscriptInOrder) {
  NEEDS_ACOUSTIC_MODEL();
  const auto said = spoken(sentence);
  const AlignResult result = aligned(said.audio, sentence);
  expect_tiles(result.phones, said.audio);
  std::string words;
  for (std::size_t i = 0; i < result.phones.phones.size(); ++i) {
    const Phone& phone = result.phones.phones[i];
    if (!phone.word.empty() && (i == 0 || result.phones.phones[i - 1].word != phone.word)) words += phone.word + " ";
    EXPECT_EQ(phone.word.empty(), phone.label == "SIL");
  }
  EXPECT_EQ(words, "bob and pam built a very big boat for my mother ");
  EXPECT_TRUE(result.matches);
  EXPECT_TRUE(result.phones.confident);
  EXPECT_EQ(result.report, "");
}

TEST(Align, GivesEveryPhoneThreeFramesAndEveryBilabialAClosure) {
  NEEDS_ACOUSTIC_MODEL();
  for (const Voice voice : {Voice::slt, Voice::rms, Voice::awb}) {
    for (const std::size_t i : {0u, 1u, 10u, 19u, 23u}) {
      const auto said = spoken(test::labial_sentences[i], voice);
      const AlignResult result = aligned(said.audio, test::labial_sentences[i]);
      expect_tiles(result.phones, said.audio);
      for (const Phone& phone : test::whole_phones(result.phones))
        EXPECT_GE(phone.end_s - phone.start_s, 0.030 - 1e-9) << phone.label << " at " << phone.start_s;
      const auto& phones = result.phones.phones;
      for (std::size_t k = 0; k + 1 < phones.size(); ++k) {
        // The last sound before a pause is drawn out, an M too.
        const bool held_m = phones[k].label == "M" && phones[k + 1].label != "SIL";
        if (phones[k].label != "P.c" && phones[k].label != "B.c" && !held_m) continue;
        EXPECT_GE(phones[k].end_s - phones[k].start_s, 0.020 - 1e-9) << phones[k].label << " at " << phones[k].start_s;
        EXPECT_LE(phones[k].end_s - phones[k].start_s, 0.150 + 1e-9) << phones[k].label << " at " << phones[k].start_s;
      }
    }
  }
}

TEST(Align, MovesWithSilencePutBeforeTheSpeech) {
  NEEDS_ACOUSTIC_MODEL();
  const auto said = spoken(sentence);
  const Phones plain = aligned(said.audio, sentence).phones;
  for (const double more_s : {0.01, 0.1, 0.5}) {
    Audio longer = silence(more_s);
    longer.samples.insert(longer.samples.end(), said.audio.samples.begin(), said.audio.samples.end());
    // Multiples of a frame move exactly, but for the rest of the window over the cut silence.
    EXPECT_LE(largest_shift_s(plain, aligned(longer, sentence).phones, more_s), 0.0101) << more_s;
  }
}

TEST(Align, HardlyMovesWithGainAndOffset) {
  NEEDS_ACOUSTIC_MODEL();
  const auto said = spoken(sentence);
  const Phones plain = aligned(said.audio, sentence).phones;
  for (const float gain : {0.1F, 0.5F, 1.5F, 4.0F}) {
    Audio other = said.audio;
    for (float& s : other.samples) s = gain * s + 0.02F;
    EXPECT_LE(largest_shift_s(plain, aligned(other, sentence).phones), 0.0101) << gain;
  }
}

TEST(Align, GivesTheSameOnRepeatAndFromSeveralThreads) {
  NEEDS_ACOUSTIC_MODEL();
  Audio audio;
  std::string text;
  for (std::size_t i = 0; i < 5; ++i) {  // long enough for several pieces
    const auto said = spoken(test::labial_sentences[i]);
    audio.samples.insert(audio.samples.end(), said.audio.samples.begin(), said.audio.samples.end());
    text += std::string(test::labial_sentences[i]) + " ";
  }
  const AlignResult once = aligned(audio, text);
  std::vector<AlignResult> results(3);
  std::vector<std::thread> threads;
  for (AlignResult& result : results) threads.emplace_back([&] { result = aligned(audio, text); });
  for (std::thread& thread : threads) thread.join();
  for (const AlignResult& result : results) {
    ASSERT_EQ(result.phones.phones.size(), once.phones.phones.size());
    for (std::size_t i = 0; i < once.phones.phones.size(); ++i) {
      EXPECT_EQ(result.phones.phones[i].end_s, once.phones.phones[i].end_s);
      EXPECT_EQ(result.phones.phones[i].score, once.phones.phones[i].score);
    }
  }
}

TEST(Align, OfSentencesInARowEqualsThatOfEach) {
  NEEDS_ACOUSTIC_MODEL();
  Audio audio;
  std::string text;
  std::vector<Phone> parts;
  for (std::size_t i = 0; audio.duration_s() < 75; ++i) {  // beyond one chunk of the first pass
    const std::string line = test::labial_sentences[i % test::labial_sentences.size()];
    const auto said = spoken(line);
    const double start_s = audio.duration_s();
    for (Phone phone : test::whole_phones(aligned(said.audio, line).phones)) {
      phone.end_s += start_s;
      if (phone.label == "SIL" && !parts.empty() && parts.back().label == "SIL")
        parts.back().end_s = phone.end_s;
      else
        parts.push_back(phone);
    }
    audio.samples.insert(audio.samples.end(), said.audio.samples.begin(), said.audio.samples.end());
    text += line + " ";
  }
  const AlignResult whole = aligned(audio, text);
  EXPECT_TRUE(whole.matches) << whole.report;
  const test::BoundaryErrors errors = test::boundary_errors(test::whole_phones(whole.phones), parts);
  EXPECT_GE(errors.errors_ms.size(), parts.size() * 9 / 10);
  EXPECT_GE(errors.share_within(20), 0.97);  // loudness and cepstral mean are taken over more speech
}

TEST(Align, NeverFailsInWhiteNoise) {
  NEEDS_ACOUSTIC_MODEL();
  for (const Voice voice : {Voice::slt, Voice::rms, Voice::awb}) {
    for (const double snr_db : {30.0, 20.0, 10.0, 5.0}) {
      for (const std::size_t i : {2u, 7u, 21u}) {
        const std::string text = test::labial_sentences[i];
        const Audio noisy = test::with_noise(spoken(text, voice).audio, snr_db);
        const AlignResult result = aligned(noisy, text);
        expect_tiles(result.phones, noisy);
        std::size_t found = 0, last = 0;  // every word is there
        for (std::size_t k = 0; k < result.phones.phones.size(); ++k)
          if (!result.phones.phones[k].word.empty()) ++found, last = k;
        EXPECT_GT(found, text.size() / 3);
        EXPECT_FALSE(result.phones.phones[last].word.empty());
      }
    }
  }
}

TEST(Align, SaysThatAndWhereATranscriptDoesNotMatch) {
  NEEDS_ACOUSTIC_MODEL();
  test::Warnings warnings;
  const auto said = spoken("Perhaps they forgot to move the heavy bamboo box.");
  const std::string other = "Nine tiny kittens chase a silver string across the green.";
  const AlignResult result =
      face::speech::align(said.audio, &other, test::acoustic_model(), test::dictionary(), nullptr, {}, warnings);
  expect_tiles(result.phones, said.audio);
  EXPECT_FALSE(result.matches);
  EXPECT_LT(result.mean_score, aligned(said.audio, "Perhaps they forgot to move the heavy bamboo box.").mean_score - 2);
  ASSERT_FALSE(warnings.texts.empty());
  EXPECT_TRUE(warnings.texts[0].starts_with("the text does not fit the sound from ")) << warnings.texts[0];
}

TEST(Align, NamesThePlaceOfAWrongPassageInARightTranscript) {
  NEEDS_ACOUSTIC_MODEL();
  const auto said = spoken(
      "The farmer found five fat foxes in the barn. Vivian prefers fresh berries over pumpkin pie. Please put the "
      "paper cup on top.");
  const AlignResult result = aligned(said.audio,
                                     "The farmer found five fat foxes in the barn. Nobody thinks a thousand dollars is "
                                     "enough. Please put the paper cup on top.");
  EXPECT_NE(result.report.find("the text does not fit the sound from "), std::string::npos) << result.mean_score;
  EXPECT_NE(result.report.find("thousand"), std::string::npos) << result.report;
  EXPECT_EQ(result.report.find("paper"), std::string::npos) << result.report;
}

TEST(Align, SaysWhereTheTextHasNoWordsForTheSound) {
  NEEDS_ACOUSTIC_MODEL();
  const auto said =
      spoken("The farmer found five fat foxes in the barn. Vivian prefers fresh berries over pumpkin pie.");
  const AlignResult result = aligned(said.audio, "The farmer found five fat foxes in the barn.");
  EXPECT_FALSE(result.matches);
  EXPECT_NE(result.report.find("the text has no words for the sound from "), std::string::npos) << result.report;
}

TEST(Align, ReportsWordsThatTheDictionaryLacks) {
  NEEDS_ACOUSTIC_MODEL();
  const auto said = spoken("The blorft met 12 people.");
  const AlignResult result = aligned(said.audio, "The blorft met 12 people!");
  EXPECT_TRUE(result.matches);
  EXPECT_EQ(result.report, "\"blorft\" is not in the dictionary: taken as B L AO R F T\n");
}

TEST(Align, LeavesOutWordsThatFindNoRoom) {
  NEEDS_ACOUSTIC_MODEL();
  Audio clip = spoken("Bob bought a boat.").audio;
  clip.samples.resize(static_cast<std::size_t>(0.3 * 16000));
  const AlignResult result = aligned(clip, "Bob bought a boat and sailed it over the wide blue sea for many months");
  expect_tiles(result.phones, clip);
  EXPECT_FALSE(result.matches);
  EXPECT_NE(result.report.find("words find no room in the audio, from \""), std::string::npos) << result.report;
}

TEST(Align, TakesClipsOfAnyLength) {
  NEEDS_ACOUSTIC_MODEL();
  const Audio whole = spoken("Bob bought a boat.").audio;
  for (const std::size_t samples : {1u, 100u, 410u, 1000u, 4800u, 16000u}) {
    Audio clip = whole;
    clip.samples.erase(clip.samples.begin(), clip.samples.begin() + 4000);
    clip.samples.resize(samples);
    expect_tiles(aligned(clip, "bob").phones, clip);
    expect_tiles(recognised(clip, nullptr).phones, clip);
  }
}

TEST(Align, CallsSilenceSilence) {
  NEEDS_ACOUSTIC_MODEL();
  const Audio audio = silence(2);
  const AlignResult result = aligned(audio, "hello there");
  expect_tiles(result.phones, audio);
  ASSERT_EQ(result.phones.phones.size(), 1u);
  EXPECT_EQ(result.phones.phones[0].label, "SIL");
  EXPECT_FALSE(result.matches);
  EXPECT_EQ(result.report, "the audio is silent: no word of the text was placed\n");
  EXPECT_EQ(recognised(audio, nullptr).phones.phones.size(), 1u);
}

TEST(Align, RecognisesPhonesWithoutATranscript) {
  NEEDS_ACOUSTIC_MODEL();
  const auto said = spoken("My mother makes much money from many maps.");
  const engine::File phone_model = test::phone_model();
  for (const engine::File* model : {static_cast<const engine::File*>(nullptr), &phone_model}) {
    const AlignResult result = recognised(said.audio, model);
    expect_tiles(result.phones, said.audio);
    EXPECT_FALSE(result.phones.confident);
    std::size_t lips = 0;
    for (const Phone& phone : result.phones.phones) {
      EXPECT_EQ(phone.word, "");
      if (phone.label == "M" || phone.label == "B.c" || phone.label == "P.c") ++lips;
    }
    EXPECT_GE(lips, 4u);  // of 8
  }
}

TEST(Align, RecognisesPhonesWhereTheTextHasNoWords) {
  NEEDS_ACOUSTIC_MODEL();
  const auto said = spoken("Bob bought a boat.");
  const AlignResult result = aligned(said.audio, " ... ");
  EXPECT_FALSE(result.phones.confident);
  EXPECT_GT(result.phones.phones.size(), 5u);
  EXPECT_EQ(result.report, "the text has no words: phones are recognised from the sound\n");
}

TEST(Align, SurvivesATextGridExactly) {
  NEEDS_ACOUSTIC_MODEL();
  const auto said = spoken(sentence);
  const Phones phones = aligned(said.audio, sentence).phones;
  const std::string path = testing::TempDir() + "/align.TextGrid";
  std::ofstream(path) << face::write_text_grid(face::text_grid_from_phones(phones));
  const Phones back = face::speech::read_phones(engine::File::at(path), nullptr);
  ASSERT_EQ(back.phones.size(), phones.phones.size());
  for (std::size_t i = 0; i < phones.phones.size(); ++i) {
    EXPECT_EQ(back.phones[i].label, phones.phones[i].label);
    EXPECT_EQ(back.phones[i].start_s, phones.phones[i].start_s);
    EXPECT_EQ(back.phones[i].end_s, phones.phones[i].end_s);
    EXPECT_EQ(back.phones[i].word, phones.phones[i].word);
  }
}

TEST(Align, PrintsNothing) {
  NEEDS_ACOUSTIC_MODEL();
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  aligned(spoken("Bob.").audio, "Bob");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Align, RefusesEmptyAudioAndAnotherRate) {
  NEEDS_ACOUSTIC_MODEL();
  EXPECT_THROW_TEXT(aligned({}, "hello"), "the audio is empty: there is nothing to align");
  Audio audio = silence(1);
  audio.rate_hz = 44100;
  EXPECT_THROW_TEXT(aligned(audio, "hello"), "the audio has 44100 Hz, expected 16000 Hz");
  audio.rate_hz = 16000;
  audio.samples[7] = NAN;
  EXPECT_THROW_TEXT(aligned(audio, "hello"), "sample 7 of the audio is not a number");
}

TEST(Align, RefusesAFolderThatIsNoAcousticModel) {
  NEEDS_ACOUSTIC_MODEL();
  engine::Progress progress;
  const std::string text = "bob";
  const engine::File folder = engine::File::folder(testing::TempDir(), {{"readme.txt", "/dev/null"}});
  EXPECT_THROW_TEXT(
      face::speech::align(spoken("Bob.").audio, &text, folder, test::dictionary(), nullptr, {}, progress),
      "the acoustic model " + folder.name() + " has no file mdef: expected a PocketSphinx model folder such as en-us");
  const engine::File broken = engine::File::folder("broken", {{"mdef", "/dev/null"},
                                                              {"means", "/dev/null"},
                                                              {"variances", "/dev/null"},
                                                              {"transition_matrices", "/dev/null"}});
  EXPECT_THROW(face::speech::align(spoken("Bob.").audio, &text, broken, test::dictionary(), nullptr, {}, progress),
               std::exception);
}
