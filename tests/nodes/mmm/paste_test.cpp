// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/paste.h"

#include <gtest/gtest.h>

#include "nodes/mmm/check_labels.h"
#include "tests/support/expect_throw_text.h"

namespace face::mmm {
namespace {

Image plain(int width, int height, std::uint8_t value) {
  return {width, height, 3, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), value)};
}

TEST(Paste, IsTheMouthInTheMiddleAndTheHeadAtTheEdge) {
  const Image made = paste_mouth(plain(40, 40, 100), plain(20, 16, 200), {10, 12, 4, 60});
  const auto at = [&](int x, int y) {
    return static_cast<int>(made.pixels[static_cast<std::size_t>((y * 40 + x) * 3)]);
  };
  EXPECT_EQ(at(20, 20), 200);
  EXPECT_EQ(at(9, 20), 100);
  EXPECT_LT(at(10, 20), 106);
  for (int x = 10; x < 14; ++x) EXPECT_LE(at(x, 20), at(x + 1, 20));
}

TEST(Paste, OfTheHeadsOwnPartChangesNothing) {
  const Image head = plain(40, 40, 77);
  EXPECT_EQ(paste_mouth(head, plain(12, 12, 77), {5, 5, 6, 60}).pixels, head.pixels);
}

TEST(Paste, ShowsTheHeadsForthAndBack) {
  const std::vector<Image> heads = {plain(8, 8, 10), plain(8, 8, 20), plain(8, 8, 30)};
  const std::vector<Image> mouths(6, plain(2, 2, 0));
  std::vector<int> seen;
  engine::SeqWriter<Image> writer([&](std::string, Image image) { seen.push_back(image.pixels.back()); });
  paste(heads, mouths, writer, {3, 3, 0, 60});
  EXPECT_EQ(seen, (std::vector<int>{10, 20, 30, 20, 10, 20}));
}

TEST(Paste, RejectsAMouthThatIsNotWithinTheHead) {
  EXPECT_THROW_TEXT(paste_mouth(plain(8, 8, 0), plain(4, 4, 0), {6, 0, 1, 60}),
                    "the mouth of 4 x 4 pixels at 6, 0 does not lie within the head of 8 x 8");
}

Phones labels() { return {{{"SIL", 0, 0.4, "", 0}, {"AE", 0.4, 0.9, "bad", 0}, {"SIL", 0.9, 1.5, "", 0}}, 1.5, true}; }

TEST(CheckLabels, LetsThoseOfTheVideoPass) {
  EXPECT_EQ(check_labels(labels(), Timeline{{0, 0.5, 1.0}, 1.45}).phones.size(), 3u);
}

TEST(CheckLabels, NamesTheFirstPhoneThatDoesNotFit) {
  EXPECT_THROW_TEXT(check_labels(labels(), Timeline{{0}, 0.7}),
                    "labels do not match the video: phone 1 (AE of \"bad\") is from 0.4 s to 0.9 s, the video ends at "
                    "0.7 s");
  EXPECT_THROW_TEXT(check_labels(labels(), Timeline{{0}, 3}),
                    "labels do not match the video: the last phone (SIL) ends at 1.5 s, the video ends at 3 s");
  Phones gap = labels();
  gap.phones[2].start_s = 1.2;
  EXPECT_THROW_TEXT(check_labels(gap, Timeline{{0}, 1.5}),
                    "labels do not match the video: phone 2 (SIL) is from 1.2 s to 1.5 s, the one before it ends at "
                    "0.9 s");
  EXPECT_THROW_TEXT(check_labels(Phones{}, Timeline{{0}, 1.5}),
                    "labels do not match the video: there are none, the video lasts 1.5 s");
}

}  // namespace
}  // namespace face::mmm
