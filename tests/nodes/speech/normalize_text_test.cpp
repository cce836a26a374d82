// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/normalize_text.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

namespace {

std::string words(std::string_view text) {
  std::string joined;
  for (const std::string& word : face::speech::normalize_text(text).words) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

}  // namespace

TEST(NormalizeText, DropsPunctuationAndCase) {
  EXPECT_EQ(words("\"Hello,\" she said; (quietly) - 'Good-bye!'"), "hello she said quietly good bye");
}

TEST(NormalizeText, KeepsApostrophesInsideWords) {
  EXPECT_EQ(words("It's John\u2019s dogs' bone, don\u2019t."), "it's john's dogs bone don't");
}

TEST(NormalizeText, SpellsNumbers) {
  EXPECT_EQ(words("0 7 13 42 100 342"), "zero seven thirteen forty two one hundred three hundred forty two");
  EXPECT_EQ(words("1,250,007"), "one million two hundred fifty thousand seven");
  EXPECT_EQ(words("3.14"), "three point one four");
  EXPECT_EQ(words("007"), "zero zero seven");
}

TEST(NormalizeText, ReadsYearsOrdinalsTimesAndMoney) {
  EXPECT_EQ(words("1984, 1805, 1900, 2001"), "nineteen eighty four eighteen oh five nineteen hundred two thousand one");
  EXPECT_EQ(words("the 1st, 22nd, 30th"), "the first twenty second thirtieth");
  EXPECT_EQ(words("at 10:30 or 7:05 or 9:00"), "at ten thirty or seven oh five or nine o'clock");
  EXPECT_EQ(words("$5 and $1 and $2.50"), "five dollars and one dollar and two dollars fifty");
  EXPECT_EQ(words("80% & more"), "eighty percent and more");
}

TEST(NormalizeText, ExpandsTitlesAndSpellsAcronyms) {
  EXPECT_EQ(words("Mr. Smith and Dr. Jones on TV"), "mister smith and doctor jones on t v");
  EXPECT_EQ(words("NASA"), "nasa");
}

TEST(NormalizeText, TakesAccentsAwayAndReportsOtherScripts) {
  const auto normalized = face::speech::normalize_text("Caf\u00e9 na\u00efve \u6f22\u5b57 \u2014 end");
  EXPECT_EQ(normalized.words, (std::vector<std::string>{"cafe", "naive", "end"}));
  ASSERT_EQ(normalized.warnings.size(), 1u);
  EXPECT_EQ(normalized.warnings[0], "left out 2 characters that cannot be read as English: \u6f22\u5b57");
  std::string page, named;
  for (int i = 0; i < 1000; ++i) page += "\u6f22";
  for (int i = 0; i < 20; ++i) named += "\u6f22";
  EXPECT_EQ(face::speech::normalize_text(page).warnings.at(0),
            "left out 1000 characters that cannot be read as English: " + named + " ...");
}

TEST(NormalizeText, FindsNoWordsInPunctuation) {
  EXPECT_EQ(words(""), "");
  EXPECT_EQ(words(" ... -- !? '' \n"), "");
}

TEST(NormalizeText, SurvivesBrokenUtf8) { EXPECT_EQ(words("a\xC3"), "a"); }

TEST(NumberWords, RefusesNumbersOutOfRange) {
  EXPECT_THROW_TEXT(face::speech::number_words(-1), "number_words(-1): expected 0 to 10^15 - 1");
}
