// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/choose_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "nodes/align/upper_difference.h"
#include "tests/support/expect_throw_text.h"

namespace face::align {
namespace {

constexpr int size = 64;

// How far eyes and mouth are open, in pixels, and how far the head has moved.
struct Moment {
  int eyes = 10;
  int mouth = 4;
  double x_px = 0;
  int grain = -1;  // another in every frame; -1 = none
};

// Grainy skin that gets brighter to the right, two eyes with a dark iris, and a mouth below them.
Image picture_of(const Moment& moment) {
  Image picture{size, size, 1, {}};
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double at = x - moment.x_px;
      const bool eye = std::fabs(std::fabs(at - 32) - 12) < 8 && y >= 24 - moment.eyes && y < 24;
      const bool iris = std::fabs(std::fabs(at - 32) - 12) < 3;
      const bool mouth = std::fabs(at - 32) < 12 && y >= 50 && y < 50 + moment.mouth;
      const int grain = moment.grain < 0 ? 0 : (7 * x + 5 * y + x * y * moment.grain) % 5;
      const long skin = std::lround(100 + 0.5 * at) + grain;
      picture.pixels.push_back(static_cast<std::uint8_t>(mouth ? 20 : eye ? (iris ? 40 : 220) : skin));
    }
  return picture;
}

Landmarks markers_of(const Moment& moment) {
  Landmarks markers;
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{
           {10, 8}, {54, 8}, {10, 30}, {54, 30}, {32, 30}, {32, 8}, {16, 56}, {48, 56}, {32, 60}, {24, 60}})
    markers.points.push_back({std::to_string(markers.points.size()), x + moment.x_px, y, true});
  return markers;
}

std::string chosen_of(std::vector<Moment> moments, const ChooseReferenceOptions& options = {}) {
  std::vector<DepthScan> scans;
  std::vector<Landmarks> markers;
  std::vector<Image> interiors;
  for (Moment& moment : moments) {
    moment.grain = static_cast<int>(scans.size());
    scans.push_back({{}, picture_of(moment), {}});
    markers.push_back(markers_of(moment));
    interiors.push_back({10, 1, 1, std::vector<std::uint8_t>(10, 0)});
    for (int i = 0; i < moment.mouth; ++i) interiors.back().pixels[static_cast<std::size_t>(i)] = 255;
  }
  return choose_reference(engine::Seq<DepthScan>(scans), engine::Seq<Landmarks>(markers), engine::Seq<Image>(interiors),
                          options)
      .frame;
}

}  // namespace

TEST(ChooseReference, PassesOverABlink) {
  // The third has the mouth that is wanted, three tenths of the widest, and its eyes shut.
  EXPECT_EQ(chosen_of({{10, 0}, {10, 10}, {0, 3}, {10, 9}, {10, 4}, {10, 10}, {10, 0}}), "4");
  EXPECT_EQ(chosen_of({{10, 0}, {10, 10}, {5, 3}, {10, 9}, {10, 4}, {10, 10}, {10, 0}}), "4");
  EXPECT_EQ(chosen_of({{10, 0}, {10, 10}, {10, 3}, {10, 9}, {0, 4}, {10, 10}, {10, 0}}), "2");
}

TEST(ChooseReference, TakesAnyFrameWhereNoneIsTooOdd) {
  EXPECT_EQ(chosen_of({{10, 0}, {10, 10}, {0, 3}, {10, 9}, {10, 4}, {10, 10}, {10, 0}}, {.frame = "", .odd = 0}), "2");
}

TEST(ChooseReference, DoesNotMindAHeadThatMoves) {
  EXPECT_EQ(chosen_of({{10, 0}, {10, 10}, {10, 3, 5}, {10, 9}, {10, 4, -1}, {10, 10}, {10, 0}}), "2");
}

TEST(UpperDifference, SeesLidsAndNeitherMouthNorHeadMotion) {
  const auto difference = [](const Moment& a, const Moment& b) {
    return upper_difference(picture_of(a), markers_of(a), picture_of(b), markers_of(b));
  };
  EXPECT_EQ(difference({10, 4}, {10, 9}), 0);
  EXPECT_LT(difference({10, 4}, {10, 4, 3}), 1);
  EXPECT_GT(difference({10, 4}, {7, 4}), 15);
  EXPECT_GT(difference({10, 4}, {0, 4}), difference({10, 4}, {7, 4}));
}

TEST(UpperDifference, IsNothingWhereMarkersDoNotTellTheMotion) {
  Landmarks two = markers_of({});
  two.points.resize(2);
  EXPECT_EQ(upper_difference(picture_of({10, 4}), two, picture_of({0, 4}), two), 0);
  Landmarks line;
  for (int i = 0; i < 5; ++i) line.points.push_back({std::to_string(i), 10.0 * i, 5.0, true});
  EXPECT_EQ(upper_difference(picture_of({10, 4}), line, picture_of({0, 4}), line), 0);
}

TEST(UpperDifference, RejectsPicturesOfOtherSizes) {
  EXPECT_THROW_TEXT(upper_difference(picture_of({}), {}, Image{2, 3, 1, std::vector<std::uint8_t>(6, 0)}, {}),
                    "a is 64 x 64 pixels, b 2 x 3");
}

}  // namespace face::align
