// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/shape_sheet.h"

#include <gtest/gtest.h>

#include "nodes/types/arkit.h"
#include "tests/nodes/render/test_ball.h"
#include "tests/support/expect_throw_text.h"

namespace face::render {
namespace {

constexpr int gap_px = 4;

ShapeSheetOptions small_sheet() {
  ShapeSheetOptions options;
  options.columns = 8;
  options.picture_px = 40;
  return options;
}

// A ball that every shape moves in its own way; jawOpen by 30 mm down, mouthClose up again.
Rig moving_ball() {
  Rig rig = test::ball_rig(80);
  Shape& close = rig.shapes[arkit_index("mouthClose")];
  close = rig.shapes[arkit_index("jawOpen")];
  close.name = "mouthClose";
  for (Vec3f& offset : close.offsets_mm) offset[1] = 30;
  return rig;
}

// Tile number n: 0 is neutral, shape s is s + 1.
Image tile(const Image& sheet, std::size_t n, int width, int height, int row_px) {
  Image out{width, height, 3, {}};
  const int x = gap_px + static_cast<int>(n % 8) * (width + gap_px), y = gap_px + static_cast<int>(n / 8) * row_px;
  for (int row = y; row < y + height; ++row) {
    const auto first = sheet.pixels.begin() + (static_cast<std::ptrdiff_t>(row) * sheet.width + x) * 3;
    out.pixels.insert(out.pixels.end(), first, first + width * 3);
  }
  return out;
}

int row_px(const Image& sheet) { return (sheet.height - gap_px) / 7; }  // 53 pictures, 8 to a row

TEST(ShapeSheet, ShowsEveryShapeAtWeightOne) {
  const Rig rig = moving_ball();
  const Image sheet = shape_sheet(rig, nullptr, small_sheet());
  EXPECT_EQ(sheet.width, 8 * (40 + gap_px) + gap_px);
  RenderHeadOptions view;
  view.width_px = view.height_px = 40;
  view.yaw_deg = 15;
  view.framing = Framing::face;
  const auto at = [&](std::size_t n) { return tile(sheet, n, 40, 40, row_px(sheet)).pixels; };
  EXPECT_EQ(at(0), render_head(rig, {}, view).pixels);
  Weights open;
  open.values.assign(arkit_count, 0.0f);
  open.values[arkit_index("jawOpen")] = 1;
  EXPECT_EQ(at(arkit_index("jawOpen") + 1), render_head(rig, open, view).pixels);
  EXPECT_EQ(at(arkit_index("tongueOut") + 1), at(0));  // the last one; this ball does not know it
}

TEST(ShapeSheet, ShowsMouthCloseWithTheJawOpen) {
  const Image sheet = shape_sheet(moving_ball(), nullptr, small_sheet());
  const auto at = [&](std::size_t n) { return tile(sheet, n, 40, 40, row_px(sheet)).pixels; };
  EXPECT_NE(at(arkit_index("jawOpen") + 1), at(0));
  EXPECT_EQ(at(arkit_index("mouthClose") + 1), at(0));  // down and up again
}

TEST(ShapeSheet, PutsASecondHeadToTheRight) {
  const Rig ball = moving_ball(), other = test::ball_rig(60);
  const Image left = shape_sheet(ball, nullptr, small_sheet()), right = shape_sheet(other, nullptr, small_sheet());
  const Image both = shape_sheet(ball, &other, small_sheet());
  EXPECT_EQ(both.width, 8 * (80 + gap_px) + gap_px);
  EXPECT_EQ(both.height, left.height);
  for (const std::size_t n : {std::size_t{0}, arkit_index("jawOpen") + 1, arkit_index("mouthClose") + 1}) {
    const Image pair = tile(both, n, 80, 40, row_px(both));
    const Image a = tile(left, n, 40, 40, row_px(left)), b = tile(right, n, 40, 40, row_px(right));
    for (std::ptrdiff_t y = 0; y < 40; ++y) {
      const auto row = pair.pixels.begin() + y * 240;
      ASSERT_TRUE(std::equal(row, row + 120, a.pixels.begin() + y * 120)) << "shape " << n << ", row " << y;
      ASSERT_TRUE(std::equal(row + 120, row + 240, b.pixels.begin() + y * 120)) << "shape " << n << ", row " << y;
    }
  }
}

TEST(ShapeSheet, SaysWhichShapesAreMissing) {
  Rig rig = moving_ball();
  const Image whole = shape_sheet(rig, nullptr, small_sheet());
  rig.missing = {"tongueOut"};
  const Image lacking = shape_sheet(rig, nullptr, small_sheet());
  EXPECT_NE(whole.pixels, lacking.pixels);
  EXPECT_EQ(tile(whole, 52, 40, 40, row_px(whole)).pixels, tile(lacking, 52, 40, 40, row_px(lacking)).pixels);
}

TEST(ShapeSheet, RejectsWhatItCannotShow) {
  ShapeSheetOptions options = small_sheet();
  options.picture_px = 0;
  EXPECT_THROW_TEXT(shape_sheet(moving_ball(), nullptr, options), "picture_px is 0, expected at least 1");
  options = small_sheet();
  options.columns = 0;
  EXPECT_THROW_TEXT(shape_sheet(moving_ball(), nullptr, options), "columns is 0, expected at least 1");
  EXPECT_THROW_TEXT(shape_sheet(Rig{}, nullptr, small_sheet()), "the rig has no visible polygon to render");
}

}  // namespace
}  // namespace face::render
