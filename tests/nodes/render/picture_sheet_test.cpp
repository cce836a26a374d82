// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/picture_sheet.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::render;

Image plain(std::uint8_t grey) { return {40, 30, 3, std::vector<std::uint8_t>(40 * 30 * 3, grey)}; }

TEST(PictureSheet, PutsPicturesInRowsInTheirOrder) {
  const engine::Seq<Image> images({plain(10), plain(90), plain(170)}, {"a", "b", "c"});
  PictureSheetOptions options;
  options.columns = 2;
  options.captions = false;
  const Image sheet = picture_sheet(images, options);
  const auto at = [&](int x, int y) {
    return sheet.pixels[static_cast<std::size_t>((y * sheet.width + x) * sheet.channels)];
  };
  EXPECT_EQ(at(20, 15), 10);
  EXPECT_EQ(at(64, 15), 90);
  EXPECT_EQ(at(20, 49), 170);
  options.captions = true;
  EXPECT_GT(picture_sheet(images, options).height, sheet.height);
}

TEST(PictureSheet, RejectsNoPictures) {
  EXPECT_THROW_TEXT(picture_sheet(engine::Seq<Image>()), "there are no pictures for the sheet");
}

}  // namespace
