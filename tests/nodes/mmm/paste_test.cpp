// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/paste.h"

#include <gtest/gtest.h>

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
  paste(heads, mouths, nullptr, writer, {3, 3, 0, 60});
  EXPECT_EQ(seen, (std::vector<int>{10, 20, 30, 20, 10, 20}));
}

TEST(Paste, RejectsAMouthThatIsNotWithinTheHead) {
  EXPECT_THROW_TEXT(paste_mouth(plain(8, 8, 0), plain(4, 4, 0), {6, 0, 1, 60}),
                    "the mouth of 4 x 4 pixels at 6, 0 does not lie within the head of 8 x 8");
}

}  // namespace
}  // namespace face::mmm
