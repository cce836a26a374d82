// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/read_phones.h"

#include <gtest/gtest.h>

#include "nodes/base/phones_json.h"
#include "nodes/base/text_grid.h"
#include "nodes/speech/say.h"
#include "tests/nodes/speech/speech_material.h"
#include "tests/support/data.h"
#include "tests/support/expect_throw_text.h"

using face::speech::read_phones;

namespace {

engine::File file(const std::string& name, const std::string& content) {
  const std::string path = testing::TempDir() + "/" + name;
  std::ofstream(path, std::ios::binary) << content;
  return engine::File::at(path);
}

std::string grid_text(const std::vector<face::TextGridTier>& tiers, double end_s = 1) {
  return face::write_text_grid({0, end_s, tiers});
}

void expect_equal(const face::Phones& a, const face::Phones& b) {
  ASSERT_EQ(a.phones.size(), b.phones.size());
  EXPECT_EQ(a.duration_s, b.duration_s);
  for (std::size_t i = 0; i < a.phones.size(); ++i) {
    EXPECT_EQ(a.phones[i].label, b.phones[i].label);
    EXPECT_EQ(a.phones[i].start_s, b.phones[i].start_s);
    EXPECT_EQ(a.phones[i].end_s, b.phones[i].end_s);
    EXPECT_EQ(a.phones[i].word, b.phones[i].word);
  }
}

}  // namespace

TEST(ReadPhones, GivesAWrittenAlignmentBackExactly) {
  engine::Progress progress;
  const face::Phones phones = face::speech::say("Peter's big cat, then.", nullptr, {}, progress).phones;
  expect_equal(read_phones(file("a.TextGrid", face::write_text_grid(face::text_grid_from_phones(phones))), nullptr),
               phones);
  expect_equal(read_phones(file("a.phones.json", face::write_phones_json(phones)), nullptr), phones);
}

TEST(ReadPhones, TakesATextGridOfTheMontrealAligner) {
  const face::Phones phones = read_phones(
      file("m.TextGrid",
           grid_text({{"ann - words", {{0, 0.2, ""}, {0.2, 0.6, "Map"}, {0.6, 1, ""}}},
                      {"ann - phones",
                       {{0, 0.2, "sp"}, {0.2, 0.3, "M"}, {0.3, 0.5, "AE1"}, {0.5, 0.6, "P"}, {0.6, 1, "sil"}}}})),
      nullptr);
  ASSERT_EQ(phones.phones.size(), 6u);
  EXPECT_EQ(phones.phones[2].label, "AE");
  EXPECT_EQ(phones.phones[2].word, "map");
  EXPECT_EQ(phones.phones[3].label, "P.c");
  EXPECT_NEAR(phones.phones[3].end_s, 0.56, 1e-12);  // 60 % without audio
  EXPECT_EQ(phones.phones[5].label, "SIL");
  EXPECT_EQ(phones.phones[5].word, "");
}

TEST(ReadPhones, FindsTheBurstWhereTheAudioIsGiven) {
  engine::Progress progress;
  const face::speech::SayResult said = face::speech::say("Bob bit a pipe.", nullptr, {}, progress);
  face::Phones whole = said.phones;
  whole.phones = test::whole_phones(said.phones);
  const engine::File json = file("w.json", face::write_phones_json(whole));
  expect_equal(read_phones(json, &said.audio), said.phones);
}

TEST(ReadPhones, ClosesGapsWithSilence) {
  const face::Phones phones = read_phones(
      file("g.json",
           R"([{"phone": "AA", "start_s": 0.1, "end_s": 0.2}, {"phone": "M", "start_s": 0.5, "end_s": 0.6}])"),
      nullptr);
  ASSERT_EQ(phones.phones.size(), 4u);
  EXPECT_EQ(phones.phones[0].label, "SIL");
  EXPECT_EQ(phones.phones[2].label, "SIL");
  EXPECT_EQ(phones.phones[2].start_s, 0.2);
  EXPECT_EQ(phones.duration_s, 0.6);
}

TEST(ReadPhones, LastsAsLongAsItsAudio) {
  face::Audio audio;
  audio.samples.resize(16000);
  const face::Phones phones = read_phones(file("l.json", R"([{"phone": "AA", "start_s": 0, "end_s": 0.5}])"), &audio);
  ASSERT_EQ(phones.phones.size(), 2u);
  EXPECT_EQ(phones.phones[1].end_s, 1);
  EXPECT_THROW_TEXT(read_phones(file("l.json", R"([{"phone": "AA", "start_s": 0, "end_s": 1.5}])"), &audio),
                    "l.json: the phones end at 1.5 s, but the audio at 1 s");
}

TEST(ReadPhones, SaysWhatIsWrongWithAFile) {
  EXPECT_THROW_TEXT(
      read_phones(engine::File::at("/no/such.TextGrid"), nullptr),
      "cannot open /no/such.TextGrid: expected an alignment (.TextGrid, phones.json, Rhubarb's .json, TIMIT's "
      ".phn, GRID's .align)");
  EXPECT_THROW_TEXT(
      read_phones(file("a.lab", "x"), nullptr),
      "a.lab: found the suffix \".lab\", expected one of .TextGrid, phones.json, Rhubarb's .json, TIMIT's .phn, "
      "GRID's .align; Praat and the Montreal aligner can write a TextGrid of other alignments");
  EXPECT_THROW_TEXT(read_phones(file("e.json", "[]"), nullptr), "e.json: found no phones");
  EXPECT_THROW_TEXT(read_phones(file("q.json", R"([{"phone": "QQ", "start_s": 0, "end_s": 1}])"), nullptr),
                    "q.json: found the phone \"QQ\" at 0 s, expected ARPAbet (AA to ZH) or silence");
  EXPECT_THROW_TEXT(read_phones(file("o.json", R"([{"phone": "AA", "start_s": 0, "end_s": 1},
      {"phone": "M", "start_s": 0.5, "end_s": 2}])"),
                                nullptr),
                    "o.json: found \"M\" from 0.5 s, expected no less than 1 s, where the segment before it ends");
  EXPECT_THROW_TEXT(read_phones(file("t.TextGrid", grid_text({{"notes", {{0, 1, "x"}}}})), nullptr),
                    "t.TextGrid: found the tiers \"notes\", expected one named \"phones\"");
}

TEST(ReadPhones, ReadsTimitWithItsClosuresAndReleases) {
  // The closure of an affricate is part of it, one that is not released is a whole stop.
  const face::Phones phones = read_phones(file("sa.phn",
                                               "0 1600 h#\n1600 3200 bcl\n3200 3520 b\n3520 8000 ax\n8000 9600 tcl\n"
                                               "9600 11200 ch\n11200 12800 kcl\n12800 16000 q\n"),
                                          nullptr);
  std::string labels;
  for (const face::Phone& phone : phones.phones) labels += phone.label + " ";
  EXPECT_EQ(labels, "SIL B.c B.r AH CH K.c K.r SIL ");
  EXPECT_NEAR(phones.phones[2].start_s, 0.2, 1e-12);
  EXPECT_NEAR(phones.phones[2].end_s, 0.22, 1e-12);
  EXPECT_NEAR(phones.phones[4].start_s, 0.5, 1e-12);
  EXPECT_NEAR(phones.phones[4].end_s, 0.7, 1e-12);
  EXPECT_NEAR(phones.duration_s, 1, 1e-12);
  EXPECT_TRUE(phones.confident);
}

TEST(ReadPhones, ReadsTheWordsOfGridAndGuessesTheirPhones) {
  const face::Phones phones =
      read_phones(file("s.align", "0 12250 sil\r\n12250 19250 set\r\n19250 25000 sp\r\n"), nullptr);
  std::string labels;
  for (const face::Phone& phone : phones.phones) labels += phone.label + " ";
  EXPECT_EQ(labels, "SIL S EH T.c T.r SIL ");
  EXPECT_NEAR(phones.phones[1].start_s, 0.49, 1e-12);
  EXPECT_NEAR(phones.phones[2].start_s, 0.49 + 0.07, 1e-12);  // a quarter of 0.28 s
  EXPECT_NEAR(phones.phones[2].end_s, 0.49 + 0.21, 1e-12);
  EXPECT_EQ(phones.phones[2].word, "set");
  EXPECT_NEAR(phones.duration_s, 1, 1e-12);
  EXPECT_FALSE(phones.confident);
}

TEST(ReadPhones, ReadsTheMouthShapesOfRhubarb) {
  const face::Phones phones =
      read_phones(file("r.json", R"({"metadata": {"soundFile": "a.wav", "duration": 0.9}, "mouthCues": [
    {"start": 0.00, "end": 0.25, "value": "X"}, {"start": 0.25, "end": 0.40, "value": "A"},
    {"start": 0.40, "end": 0.90, "value": "D"}]})"),
                  nullptr);
  ASSERT_EQ(phones.phones.size(), 3u);
  EXPECT_EQ(phones.phones[0].label, "SIL");
  EXPECT_EQ(phones.phones[1].label, "M");
  EXPECT_EQ(phones.phones[2].label, "AA");
  EXPECT_EQ(phones.phones[2].end_s, 0.9);
  EXPECT_FALSE(phones.confident);
}

TEST(ReadPhones, NamesTheLineOfAnAlignmentThatIsWrong) {
  EXPECT_THROW_TEXT(
      read_phones(file("x.phn", "0 100 h#\n100 b\n"), nullptr),
      "x.phn:2: found \"100 b\", expected begin and end in samples and a phone, such as \"2480 3400 sh\"");
  EXPECT_THROW_TEXT(read_phones(file("y.phn", "200 100 h#\n"), nullptr),
                    "y.phn:1: found 200 to 100, expected an end after its begin");
  EXPECT_THROW_TEXT(read_phones(file("z.phn", "0 100 zz\n"), nullptr),
                    "z.phn: found the phone \"zz\" at 0 s, expected ARPAbet (AA to ZH) or silence");
  EXPECT_THROW_TEXT(read_phones(file("x.align", "0 100 gr33n\n"), nullptr),
                    "x.align:1: found the word \"gr33n\", expected letters");
  EXPECT_THROW_TEXT(read_phones(file("v.json", R"({"mouthCues": [{"start": 0, "end": 1, "value": "Q"}]})"), nullptr),
                    "v.json: /mouthCues/0/value: found \"Q\", expected one of A to H, or X");
  EXPECT_THROW_TEXT(read_phones(file("e.phn", ""), nullptr), "e.phn: found no phones");
}

TEST(ReadPhones, ReadsAnAlignmentOfGrid) {
  DATA_FILE(path, "grid/swwp2s.align");
  const face::Phones phones = read_phones(engine::File::at(path), nullptr);
  EXPECT_NEAR(phones.duration_s, 2.98, 1e-9);
  std::string words;
  for (const face::Phone& phone : phones.phones)
    if (!phone.word.empty() && !words.ends_with(phone.word + " ")) words += phone.word + " ";
  EXPECT_EQ(words, "set white with p two soon ");
}
