// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/text_grid.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

namespace {

const std::string long_form =
    "File type = \"ooTextFile\"\nObject class = \"TextGrid\"\n\nxmin = 0\nxmax = 1.5\ntiers? <exists>\nsize = 2\nitem "
    "[]:\n"
    "    item [1]:\n        class = \"IntervalTier\"\n        name = \"words\"\n        xmin = 0\n        xmax = 1.5\n"
    "        intervals: size = 2\n        intervals [1]:\n            xmin = 0\n            xmax = 0.5\n"
    "            text = \"\"\n        intervals [2]:\n            xmin = 0.5\n            xmax = 1.5\n"
    "            text = \"say \"\"hi\"\"\"\n    item [2]:\n        class = \"TextTier\"\n        name = \"marks\"\n"
    "        xmin = 0\n        xmax = 1.5\n        points: size = 1\n        points [1]:\n            number = 0.7\n"
    "            mark = \"x\"\n";

const std::string short_form =
    "File type = \"ooTextFile\"\r\nObject class = \"TextGrid\"\r\n\r\n0\r\n1.5\r\n<exists>\r\n1\r\n\"IntervalTier\"\r\n"
    "\"phones\"\r\n0\r\n1.5\r\n2\r\n0\r\n0.5\r\n\"sil\"\r\n0.5\r\n1.5\r\n\"AA1\"\r\n";

std::string utf16(const std::string& ascii, bool big_endian) {
  std::string out = big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : ascii) {
    if (big_endian) out += '\0';
    out += c;
    if (!big_endian) out += '\0';
  }
  return out;
}

face::Phones some_phones() {
  face::Phones phones;
  phones.duration_s = 0.1 + 0.2;  // not a short decimal
  phones.phones = {{"SIL", 0, 0.05, "", 0},
                   {"P.c", 0.05, 1.0 / 7, "pa", 0},
                   {"P.r", 1.0 / 7, 0.15, "pa", 0},
                   {"AA", 0.15, 0.2, "pa", 0},
                   {"SIL", 0.2, 0.1 + 0.2, "", 0}};
  return phones;
}

}  // namespace

TEST(TextGrid, ReadsTheLongForm) {
  const face::TextGrid grid = face::parse_text_grid(long_form, "a.TextGrid");
  ASSERT_EQ(grid.tiers.size(), 1u);  // the point tier is read over
  EXPECT_EQ(grid.end_s, 1.5);
  EXPECT_EQ(grid.tiers[0].name, "words");
  ASSERT_EQ(grid.tiers[0].intervals.size(), 2u);
  EXPECT_EQ(grid.tiers[0].intervals[1].start_s, 0.5);
  EXPECT_EQ(grid.tiers[0].intervals[1].text, "say \"hi\"");
}

TEST(TextGrid, ReadsTheShortForm) {
  const face::TextGrid grid = face::parse_text_grid(short_form, "a.TextGrid");
  ASSERT_EQ(grid.tiers.size(), 1u);
  EXPECT_EQ(grid.tiers[0].name, "phones");
  EXPECT_EQ(grid.tiers[0].intervals[1].text, "AA1");
}

TEST(TextGrid, ReadsUtf16InBothByteOrdersAndUtf8WithAMark) {
  for (const std::string& bytes : {utf16(short_form, true), utf16(short_form, false), "\xEF\xBB\xBF" + short_form,
                                   utf16(short_form, true).substr(2), utf16(short_form, false).substr(2)}) {
    const face::TextGrid grid = face::parse_text_grid(bytes, "a.TextGrid");
    ASSERT_EQ(grid.tiers.size(), 1u);
    EXPECT_EQ(grid.tiers[0].intervals[1].text, "AA1");
  }
}

TEST(TextGrid, GivesWhatItWroteBackExactly) {
  const face::TextGrid grid = face::text_grid_from_phones(some_phones());
  const std::string text = face::write_text_grid(grid);
  const face::TextGrid back = face::parse_text_grid(text, "a.TextGrid");
  ASSERT_EQ(back.tiers.size(), 2u);
  EXPECT_EQ(back.end_s, grid.end_s);
  for (std::size_t t = 0; t < 2; ++t) {
    ASSERT_EQ(back.tiers[t].intervals.size(), grid.tiers[t].intervals.size());
    for (std::size_t i = 0; i < grid.tiers[t].intervals.size(); ++i) {
      EXPECT_EQ(back.tiers[t].intervals[i].start_s, grid.tiers[t].intervals[i].start_s);
      EXPECT_EQ(back.tiers[t].intervals[i].end_s, grid.tiers[t].intervals[i].end_s);
      EXPECT_EQ(back.tiers[t].intervals[i].text, grid.tiers[t].intervals[i].text);
    }
  }
  EXPECT_EQ(face::write_text_grid(back), text);
}

TEST(TextGrid, PutsWordsAndPhonesIntoTwoTiers) {
  const face::TextGrid grid = face::text_grid_from_phones(some_phones());
  ASSERT_EQ(grid.tiers[0].intervals.size(), 3u);
  EXPECT_EQ(grid.tiers[0].intervals[1].text, "pa");
  EXPECT_EQ(grid.tiers[0].intervals[1].end_s, 0.2);
  ASSERT_EQ(grid.tiers[1].intervals.size(), 5u);
  EXPECT_EQ(grid.tiers[1].intervals[0].text, "");
  EXPECT_EQ(grid.tiers[1].intervals[1].text, "P.c");
}

TEST(TextGrid, TellsAWordSaidTwiceInARowApart) {
  face::Phones phones;
  phones.duration_s = 0.4;
  phones.phones = {
      {"AH", 0, 0.1, "a", 0}, {"AH", 0.1, 0.2, "a", 0}, {"B", 0.2, 0.3, "be", 0}, {"IY", 0.3, 0.4, "be", 0}};
  const auto words = face::text_grid_from_phones(phones).tiers[0].intervals;
  ASSERT_EQ(words.size(), 3u);
  EXPECT_EQ(words[0].end_s, 0.1);
  EXPECT_EQ(words[1].text, "a");
}

TEST(TextGrid, SaysWhereAFileIsWrong) {
  EXPECT_THROW_TEXT(face::parse_text_grid("", "a.TextGrid"), "a.TextGrid: the file is empty, expected a TextGrid");
  EXPECT_THROW_TEXT(face::parse_text_grid("\"hello\"", "a.TextGrid"),
                    "a.TextGrid:1: found \"hello\", expected \"ooTextFile\"");
  EXPECT_THROW_TEXT(face::parse_text_grid(long_form.substr(0, long_form.find("\"say")), "a.TextGrid"),
                    "a.TextGrid:22: found the end of the file, expected the text of an interval");
  EXPECT_THROW_TEXT(face::parse_text_grid(long_form.substr(0, long_form.find("say")), "a.TextGrid"),
                    "a.TextGrid:22: found a text without a closing quote, expected the text of an interval");
  std::string swapped = long_form;
  swapped.replace(swapped.find("xmax = 0.5"), 10, "xmax = -1 ");
  EXPECT_THROW_TEXT(face::parse_text_grid(swapped, "a.TextGrid"),
                    "a.TextGrid:17: found an interval from 0 to -1, expected an end after its start");
  EXPECT_THROW_TEXT(face::parse_text_grid("ooBinaryFile\x08TextGrid", "a.TextGrid"),
                    "a.TextGrid: found a binary TextGrid, expected a text one (in Praat: Save as text file)");
}
