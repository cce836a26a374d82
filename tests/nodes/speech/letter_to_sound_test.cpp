// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/letter_to_sound.h"

#include <gtest/gtest.h>

#include "nodes/speech/arpabet.h"

using Phones = std::vector<std::string>;
using face::speech::letter_to_sound;

TEST(LetterToSound, PronouncesKnownWords) { EXPECT_EQ(letter_to_sound("map"), (Phones{"M", "AE", "P"})); }

TEST(LetterToSound, GivesEveryInventedWordPhonesOfTheSet) {
  for (const char* word : {"glorpify", "zzyzx", "blorft", "qwrt", "vumbo", "mmm", "a"}) {
    const Phones phones = letter_to_sound(word);
    EXPECT_FALSE(phones.empty()) << word;
    for (const std::string& phone : phones) EXPECT_EQ(face::speech::arpabet_label(phone), phone) << word;
  }
}

TEST(LetterToSound, AddsThePossessiveByTheLastPhone) {
  EXPECT_EQ(letter_to_sound("map's"), (Phones{"M", "AE", "P", "S"}));
  EXPECT_EQ(letter_to_sound("dog's").back(), "Z");
  const Phones phones = letter_to_sound("fox's");
  ASSERT_GE(phones.size(), 2u);
  EXPECT_EQ(phones[phones.size() - 2], "IH");
}

TEST(LetterToSound, HasNothingForAWordWithoutLetters) { EXPECT_TRUE(letter_to_sound("'").empty()); }
