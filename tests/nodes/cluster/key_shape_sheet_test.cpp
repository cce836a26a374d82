// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/key_shape_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::cluster;

Image plain(std::uint8_t level) { return {60, 40, 3, std::vector<std::uint8_t>(60 * 40 * 3, level)}; }

KeyShapes keys(const std::string& frame) {
  return {{{frame, 12, {{{"lip_0", 20, 20, true}, {"lip_6", 40, 20, true}}}}}};
}

std::size_t count(const Image& image, std::array<std::uint8_t, 3> color) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    found += std::equal(color.begin(), color.end(), image.pixels.begin() + static_cast<std::ptrdiff_t>(i));
  return found;
}

TEST(KeyShapeSheet, ShowsTheFrameOfEveryShapeAndTheCurve) {
  const engine::Seq<Image> frames({plain(10), plain(77)}, {"0", "1"});
  const Image one = key_shape_sheet(keys("1"), frames, nullptr, nullptr);
  EXPECT_GT(count(one, {77, 77, 77}), 240u * 200);  // the frame fills the picture but for the landmarks
  EXPECT_EQ(count(one, {10, 10, 10}), 0u);
  const Table curve{{"groups", "distance_merged", "error"}, {{"1", {1, 9, 5}}, {"2", {2, 3, 1}}, {"3", {3, 0, 0.5}}}};
  const Image two = key_shape_sheet(keys("1"), frames, nullptr, &curve);
  EXPECT_GT(two.width, one.width);
  EXPECT_GT(count(two, {210, 40, 40}), 100u);
  EXPECT_GT(count(two, {40, 80, 220}), 100u);
}

TEST(KeyShapeSheet, DrawsPointsWhereTheyLieInTheFrame) {
  const engine::Seq<Image> frames({plain(10), plain(77)}, {"0", "1"});
  const Landmarks moved{{{"lip_0", 24, 30, true}, {"lip_6", 44, 30, true}}};
  const engine::Seq<Landmarks> tracks({moved, moved}, {"0", "1"});
  KeyShapes there = keys("1");
  there.shapes[0].landmarks = moved;
  const Image own = key_shape_sheet(keys("1"), frames, nullptr, nullptr);
  EXPECT_EQ(key_shape_sheet(keys("1"), frames, &tracks, nullptr).pixels,
            key_shape_sheet(there, frames, nullptr, nullptr).pixels);
  EXPECT_NE(key_shape_sheet(keys("1"), frames, &tracks, nullptr).pixels, own.pixels);
  const engine::Seq<Landmarks> others({moved}, {"0"});
  EXPECT_THROW_TEXT(key_shape_sheet(keys("1"), frames, &others, nullptr), "tracks has no landmarks of key shape 1");
}

TEST(KeyShapeSheet, RejectsAFrameThatTheVideoHasNot) {
  const engine::Seq<Image> frames({plain(10)}, {"0"});
  EXPECT_THROW_TEXT(key_shape_sheet(keys("7"), frames, nullptr, nullptr), "key shape 7 is no frame of the video");
  EXPECT_THROW_TEXT(key_shape_sheet({}, frames, nullptr, nullptr), "there are no key shapes");
  const engine::Seq<Image> empty({Image{60, 40, 3, {}}}, {"7"});
  EXPECT_THROW_TEXT(key_shape_sheet(keys("7"), empty, nullptr, nullptr), "frame 7 has 0 bytes, expected 60 x 40 x 3");
}

}  // namespace
