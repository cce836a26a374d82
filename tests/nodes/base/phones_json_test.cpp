// SPDX-License-Identifier: Apache-2.0
#include "nodes/base/phones_json.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

TEST(PhonesJson, GivesWhatItWroteBackExactly) {
  face::Phones phones;
  phones.phones = {
      {"SIL", 0, 0.77, "", 0}, {"AA", 0.77, 0.1 + 0.81, "john \"j\"", -0.1}, {"N", 0.91, 1.0 / 3 + 1, "john", -4}};
  phones.duration_s = 1.0 / 3 + 1;
  const std::string text = face::write_phones_json(phones);
  const face::Phones back = face::parse_phones_json(text, "a.json");
  ASSERT_EQ(back.phones.size(), 3u);
  EXPECT_EQ(back.duration_s, phones.duration_s);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back.phones[i].label, phones.phones[i].label);
    EXPECT_EQ(back.phones[i].start_s, phones.phones[i].start_s);
    EXPECT_EQ(back.phones[i].end_s, phones.phones[i].end_s);
    EXPECT_EQ(back.phones[i].word, phones.phones[i].word);
    EXPECT_EQ(back.phones[i].score, phones.phones[i].score);
  }
  EXPECT_EQ(face::write_phones_json(back), text);
}

TEST(PhonesJson, WritesOnePhonePerLine) {
  face::Phones phones;
  phones.phones = {{"AA", 0.77, 0.91, "john", -0.1}};
  EXPECT_EQ(face::write_phones_json(phones),
            "[\n  {\"phone\": \"AA\", \"start_s\": 0.77, \"end_s\": 0.91, \"word\": \"john\", \"score\": -0.1}\n]\n");
}

TEST(PhonesJson, TakesAnEmptyList) { EXPECT_TRUE(face::parse_phones_json("[]", "a.json").phones.empty()); }

TEST(PhonesJson, SaysWhereAFileIsWrong) {
  EXPECT_THROW_TEXT(face::parse_phones_json("[\n{\"phone\": }\n]", "a.json"),
                    "a.json:2: this is not JSON: expected a list of phones");
  EXPECT_THROW_TEXT(face::parse_phones_json("{}", "a.json"), "a.json: found object, expected a list of phones");
  EXPECT_THROW_TEXT(face::parse_phones_json(R"([{"phone": "AA", "start_s": "0", "end_s": 1}])", "a.json"),
                    "a.json: /0/start_s: found \"0\", expected a number of seconds");
  EXPECT_THROW_TEXT(face::parse_phones_json(R"([{"phone": "AA", "start_s": 0}])", "a.json"),
                    "a.json: /0/end_s: found nothing, expected a number of seconds");
  EXPECT_THROW_TEXT(face::parse_phones_json(R"([{"phone": "AA", "start_s": 2, "end_s": 1}])", "a.json"),
                    "a.json: /0/end_s: found 1, expected no less than start_s = 2");
  EXPECT_THROW_TEXT(face::parse_phones_json(R"([{"phone": 7, "start_s": 2, "end_s": 1}])", "a.json"),
                    "a.json: /0/phone: found 7, expected a text");
}
