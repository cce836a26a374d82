// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/check_labels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

Phones labels() { return {{{"SIL", 0, 0.4, "", 0}, {"AE", 0.4, 0.9, "bad", 0}, {"SIL", 0.9, 1.5, "", 0}}, 1.5, true}; }

TEST(CheckLabels, LetsThoseOfTheVideoPass) {
  EXPECT_EQ(check_labels(labels(), Timeline{{0, 0.5, 1.0}, 1.45}, nullptr).phones.size(), 3u);
}

TEST(CheckLabels, NamesTheFirstPhoneThatDoesNotFit) {
  EXPECT_THROW_TEXT(check_labels(labels(), Timeline{{0}, 0.7}, nullptr),
                    "labels do not match the video: phone 1 (AE of \"bad\") is from 0.4 s to 0.9 s, the video ends at "
                    "0.7 s");
  EXPECT_THROW_TEXT(check_labels(labels(), Timeline{{0}, 3}, nullptr),
                    "labels do not match the video: the last phone (SIL) ends at 1.5 s, the video ends at 3 s");
  Phones gap = labels();
  gap.phones[2].start_s = 1.2;
  EXPECT_THROW_TEXT(check_labels(gap, Timeline{{0}, 1.5}, nullptr),
                    "labels do not match the video: phone 2 (SIL) is from 1.2 s to 1.5 s, the one before it ends at "
                    "0.9 s");
  EXPECT_THROW_TEXT(check_labels(Phones{}, Timeline{{0}, 1.5}, nullptr),
                    "labels do not match the video: there are none, the video lasts 1.5 s");
}

// Ten seconds of phones of 0.1 s that fit, and a pause at both ends.
struct Heard {
  Phones phones{{}, 10, true};
  Matrix apart_s{100, 1, std::vector<double>(100, 0.01)};
  Timeline timeline{{0}, 10};

  Heard() {
    for (int i = 0; i < 100; ++i)
      phones.phones.push_back(
          {i % 10 == 9 || i == 0 ? "SIL" : "AA", 0.1 * i, 0.1 * (i + 1), "", i % 10 == 9 ? 0.0 : -2});
  }
  void spoil(std::size_t first, std::size_t end, double score, double apart) {
    for (std::size_t i = first; i < end; ++i) phones.phones[i].score = score, apart_s.values[i] = apart;
  }
};

TEST(CheckLabels, NamesTheFirstPhoneThatIsNotWhatIsHeard) {
  Heard heard;
  EXPECT_EQ(check_labels(heard.phones, heard.timeline, &heard.apart_s).phones.size(), 100u);
  heard.spoil(51, 90, -7, 0.02);
  EXPECT_THROW_TEXT(check_labels(heard.phones, heard.timeline, &heard.apart_s),
                    "labels do not match the video: phone 51 (AA) is from 5.1 s to 5.2 s, the sound there scores -7 "
                    "with it, expected -4.5 or more");
}

TEST(CheckLabels, NamesTheFirstPhoneThatIsHeardAtAnotherTime) {
  Heard heard;
  heard.spoil(61, 99, -2, 0.4);
  EXPECT_THROW_TEXT(check_labels(heard.phones, heard.timeline, &heard.apart_s),
                    "labels do not match the video: phone 61 (AA) is from 6.1 s to 6.2 s, the sound has it 0.4 s away, "
                    "expected 0.15 s or less");
}

TEST(CheckLabels, FewPhonesThatDoNotFitAreNoOtherVideo) {
  Heard heard;
  heard.spoil(51, 56, -9, 0.3);
  EXPECT_EQ(check_labels(heard.phones, heard.timeline, &heard.apart_s).phones.size(), 100u);
}

TEST(CheckLabels, JudgesAClipThatIsShorterThanAWindow) {
  Heard heard;
  heard.phones.phones.resize(20), heard.phones.duration_s = heard.timeline.duration_s = 2;
  heard.apart_s = {20, 1, std::vector<double>(20, 0.01)};
  EXPECT_EQ(check_labels(heard.phones, heard.timeline, &heard.apart_s).phones.size(), 20u);
  heard.spoil(1, 20, -6, 0.01);
  EXPECT_THROW_TEXT(check_labels(heard.phones, heard.timeline, &heard.apart_s),
                    "labels do not match the video: phone 1 (AA) is from 0.1 s to 0.2 s, the sound there scores -6 "
                    "with it, expected -4.5 or more");
}

TEST(CheckLabels, RejectsDistancesOfOtherPhones) {
  Heard heard;
  const Matrix few{3, 1, {0, 0, 0}};
  EXPECT_THROW_TEXT(check_labels(heard.phones, heard.timeline, &few),
                    "apart_s is 3 x 1, expected 100 x 1, one of each phone");
}

}  // namespace
}  // namespace face::mmm
