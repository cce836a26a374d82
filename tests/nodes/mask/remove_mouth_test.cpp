// SPDX-License-Identifier: Apache-2.0
#include "nodes/mask/remove_mouth.h"

#include <gtest/gtest.h>

#include "nodes/base/random.h"
#include "nodes/mask/fill_holes.h"
#include "nodes/mask/reopen.h"
#include "nodes/mask/review.h"
#include "nodes/mask/smooth_depth.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/phantom_stream.h"

namespace {

using namespace face;
using namespace face::mask;
using Pose = std::map<std::string, float>;

const test::PhantomStream& stream() {
  static const test::PhantomStream made;
  return made;
}

bool is_inside(const std::string& part) { return !part.empty() && part != "face" && part != "head" && part != "neck"; }

// Distances of the removed region's upper and lower end from the inner edges of the lips, per column, px.
std::vector<int> edge_errors_px(const test::PhantomStream::Frame& frame, const Image& interior) {
  std::vector<int> errors;
  for (int x = 230; x < 410; ++x) {
    int first = -1, last = -1, found_first = -1, found_last = -1;
    for (int y = 262; y < 390; ++y) {
      const auto i = static_cast<std::size_t>(y * 640 + x);
      if (is_inside(stream().part(frame, i))) {
        if (first < 0) first = y;
        last = y;
      }
      if (interior.pixels[i]) {
        if (found_first < 0) found_first = y;
        found_last = y;
      }
    }
    if (first < 0 || found_first < 0) continue;
    errors.push_back(std::abs(first - found_first));
    errors.push_back(std::abs(last - found_last));
  }
  return errors;
}

std::size_t area_of(const Image& image) {
  return static_cast<std::size_t>(std::count(image.pixels.begin(), image.pixels.end(), 255));
}

// A wall 900 mm away with a slot of the given depth where the mouth would be.
DepthScan wall_with_slot(float slot_mm) {
  DepthScan scan;
  scan.picture = {64, 48, 1, std::vector<std::uint8_t>(64 * 48, 150)};
  scan.depth_mm.assign(64 * 48, 900);
  for (int y = 31; y < 36; ++y)
    for (int x = 27; x < 37; ++x) {
      scan.depth_mm[static_cast<std::size_t>(y * 64 + x)] = 900 + slot_mm;
      scan.picture.pixels[static_cast<std::size_t>(y * 64 + x)] = 20;
    }
  return scan;
}

}  // namespace

TEST(RemoveMouth, FindsTheInnerEdgeOfTheLipsToThreeQuartersOfAPixel) {
  for (const Pose& pose :
       {Pose{{"jawOpen", 0.15f}}, Pose{{"jawOpen", 0.5f}}, Pose{{"jawOpen", 0.3f}, {"mouthFunnel", 0.7f}},
        Pose{{"mouthLowerDownLeft", 0.5f},
             {"mouthLowerDownRight", 0.5f},
             {"mouthUpperUpLeft", 0.5f},
             {"mouthUpperUpRight", 0.5f}}}) {
    const auto frame = stream().frame(stream().weights(pose));
    const std::vector<int> errors = edge_errors_px(frame, remove_mouth(frame.scan, nullptr, nullptr).interior);
    ASSERT_GE(errors.size(), 100u);
    double sum = 0;
    for (const int e : errors) sum += e;
    EXPECT_LE(sum / static_cast<double>(errors.size()), 0.75);
    std::vector<int> sorted = errors;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_LE(sorted[sorted.size() * 95 / 100], 2);
  }
}

// Teeth in the corners lie close behind the lips.
TEST(RemoveMouth, FollowsASlitIntoTheCornersOfTheMouth) {
  for (const float open : {0.25f, 0.35f}) {
    const auto frame = stream().frame(stream().weights({{"mouthLowerDownLeft", open},
                                                        {"mouthLowerDownRight", open},
                                                        {"mouthStretchLeft", 0.4f},
                                                        {"mouthStretchRight", 0.4f}}));
    const Image interior = remove_mouth(frame.scan, nullptr, nullptr).interior;
    int teeth = 0, left = 0, taken = 0;
    for (int y = 262; y < 390; ++y)
      for (int x = 230; x < 410; ++x) {
        const auto i = static_cast<std::size_t>(y * 640 + x);
        const bool tooth = is_inside(stream().part(frame, i)) && frame.scan.picture.pixels[i] > 90;
        teeth += tooth ? 1 : 0;
        left += tooth && !interior.pixels[i] ? 1 : 0;
        taken += !is_inside(stream().part(frame, i)) && interior.pixels[i] ? 1 : 0;
      }
    EXPECT_GE(teeth, 100);
    EXPECT_LE(left, teeth / 14) << open;
    EXPECT_LE(taken, 40) << open;
  }
}

TEST(RemoveMouth, RemovesNothingFromAClosedMouth) {
  const auto frame = stream().frame(stream().weights({}));
  const RemoveMouthResult result = remove_mouth(frame.scan, nullptr, nullptr);
  EXPECT_EQ(area_of(result.interior), 0u);
  EXPECT_EQ(result.scan.depth_mm, frame.scan.depth_mm);
}

TEST(RemoveMouth, IsTheSameForAGreyPictureWithThreeChannels) {
  for (const float jaw : {0.1f, 0.2f, 0.3f, 0.5f}) {
    const auto frame = stream().frame(stream().weights({{"jawOpen", jaw}}));
    DepthScan colour = frame.scan;
    colour.picture = {frame.scan.picture.width, frame.scan.picture.height, 3, {}};
    for (const std::uint8_t grey : frame.scan.picture.pixels)
      colour.picture.pixels.insert(colour.picture.pixels.end(), 3, grey);
    const Image grey_mouth = remove_mouth(frame.scan, nullptr, nullptr).interior;
    EXPECT_GT(area_of(grey_mouth), 0u) << jaw;
    EXPECT_EQ(remove_mouth(colour, nullptr, nullptr).interior.pixels, grey_mouth.pixels);
  }
}

TEST(RemoveMouth, IsDrivenByItsOneParameter) {
  EXPECT_EQ(area_of(remove_mouth(wall_with_slot(6), nullptr, nullptr, {.threshold_mm = 4}).interior), 50u);
  EXPECT_EQ(area_of(remove_mouth(wall_with_slot(6), nullptr, nullptr, {.threshold_mm = 8}).interior), 0u);
}

TEST(RemoveMouth, ProposesAThresholdThatSeparates) {
  const RemoveMouthResult result = remove_mouth(wall_with_slot(3), nullptr, nullptr);
  EXPECT_EQ(area_of(result.interior), 0u);
  const DepthScan deep = wall_with_slot(14);
  const double proposed = remove_mouth(deep, nullptr, nullptr).report.rows[0].values[4];
  EXPECT_EQ(area_of(remove_mouth(deep, nullptr, nullptr, {.threshold_mm = proposed}).interior), 50u);
}

TEST(RemoveMouth, MovesItsRectangleWithTheLandmarks) {
  DepthScan scan = wall_with_slot(20);
  RemoveMouthOptions options;
  options.centre_x = 0.2;  // off the slot
  EXPECT_EQ(area_of(remove_mouth(scan, nullptr, nullptr, options).interior), 0u);
  const Landmarks before{{{"a", 5, 5, true}, {"b", 9, 9, true}, {"c", 7, 3, false}}};
  const Landmarks moved{{{"a", 24, 5, true}, {"b", 28, 9, true}, {"c", 0, 0, true}}};
  EXPECT_EQ(area_of(remove_mouth(scan, &moved, &before, options).interior), 50u);
}

TEST(RemoveMouth, AcceptsAScanWithoutDepth) {
  DepthScan scan = wall_with_slot(5);
  std::fill(scan.depth_mm.begin(), scan.depth_mm.end(), 0.0f);
  EXPECT_EQ(area_of(remove_mouth(scan, nullptr, nullptr).interior), 0u);
}

TEST(RemoveMouth, RejectsDepthOfAnotherSize) {
  DepthScan scan = wall_with_slot(5);
  scan.depth_mm.pop_back();
  EXPECT_THROW_TEXT(remove_mouth(scan, nullptr, nullptr), "scan has 3071 depths, its picture is 64 x 48 pixels");
}

TEST(FillHoles, InterpolatesAlongRows) {
  DepthScan scan;
  scan.picture = {6, 1, 1, std::vector<std::uint8_t>(6, 0)};
  scan.depth_mm = {0, 100, 0, 0, 106, 0};
  const FillHolesResult result = fill_holes(scan);
  EXPECT_EQ(result.scan.depth_mm, (std::vector<float>{0, 100, 102, 104, 106, 0}));
  EXPECT_EQ(result.filled.pixels, (std::vector<std::uint8_t>{0, 0, 255, 255, 0, 0}));
}

TEST(FillHoles, LeavesLongGapsAndLargeSteps) {
  DepthScan scan;
  scan.picture = {6, 1, 1, std::vector<std::uint8_t>(6, 0)};
  scan.depth_mm = {100, 0, 0, 0, 106, 0};
  EXPECT_EQ(fill_holes(scan, {.longest_px = 2}).scan.depth_mm, scan.depth_mm);
  EXPECT_EQ(fill_holes(scan, {.largest_step_mm = 5}).scan.depth_mm, scan.depth_mm);
}

TEST(SmoothDepth, BothReadingsKeepASlopeAndTakeNoiseAway) {
  DepthScan scan;
  scan.picture = {200, 40, 1, std::vector<std::uint8_t>(200 * 40, 0)};
  Random random(4);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 200; ++x) scan.depth_mm.push_back(static_cast<float>(900 + 0.1 * x + 0.2 * random.normal()));
  for (const Smoothing smoothing : {Smoothing::fits, Smoothing::kernels}) {
    const DepthScan out = smooth_depth(scan, nullptr, {.smoothing = smoothing});
    double before = 0, after = 0;
    for (int y = 0; y < 40; ++y)
      for (int x = 20; x < 180; ++x) {
        const auto i = static_cast<std::size_t>(y * 200 + x);
        before += std::pow(static_cast<double>(scan.depth_mm[i]) - 900 - 0.1 * x, 2);
        after += std::pow(static_cast<double>(out.depth_mm[i]) - 900 - 0.1 * x, 2);
      }
    EXPECT_LT(after, 0.3 * before);
  }
}

TEST(SmoothDepth, FitsKeepACubicExactly) {
  DepthScan scan;
  scan.picture = {60, 1, 1, std::vector<std::uint8_t>(60, 0)};
  for (int x = 0; x < 60; ++x) {
    const double u = (x - 30) / 30.0;
    scan.depth_mm.push_back(static_cast<float>(900 + 20 * u - 30 * u * u + 25 * u * u * u));
  }
  const DepthScan out = smooth_depth(scan, nullptr);
  // Within seven half windows of the middle nothing of the reflected ends has arrived.
  for (std::size_t x = 29; x < 31; ++x) EXPECT_NEAR(out.depth_mm[x], scan.depth_mm[x], 0.02);
}

TEST(SmoothDepth, LeavesWhatIsNotWhite) {
  DepthScan scan;
  scan.picture = {20, 1, 1, std::vector<std::uint8_t>(20, 0)};
  for (int x = 0; x < 20; ++x) scan.depth_mm.push_back(900.0f + static_cast<float>(x % 3));
  Image where{20, 1, 1, std::vector<std::uint8_t>(20, 0)};
  where.pixels[10] = 255;
  const DepthScan out = smooth_depth(scan, &where, {.smoothing = Smoothing::kernels});
  for (std::size_t x = 0; x < 20; ++x) {
    if (x == 10)
      EXPECT_NE(out.depth_mm[x], scan.depth_mm[x]);
    else
      EXPECT_EQ(out.depth_mm[x], scan.depth_mm[x]);
  }
}

TEST(SmoothDepth, RejectsAnEvenWindow) {
  DepthScan scan;
  scan.picture = {2, 1, 1, {0, 0}};
  scan.depth_mm = {1, 1};
  EXPECT_THROW_TEXT(smooth_depth(scan, nullptr, {.window_px = 8}), "window_px is 8, expected an odd number");
}

TEST(SmoothDepth, RejectsAMaskWithoutPixels) {
  const Image where{64, 48, 1, {}};
  EXPECT_THROW_TEXT(smooth_depth(wall_with_slot(0), &where), "where has 0 values, expected 3072 for 64 x 48 pixels");
}

TEST(Review, NamesTheFrameThatDepartsAndProposesItsThreshold) {
  std::vector<DepthScan> scans;
  std::vector<Image> interiors;
  std::vector<Table> reports;
  for (int t = 0; t < 9; ++t) {
    // Frame 4 has a slot too shallow for the common threshold.
    const RemoveMouthResult result = remove_mouth(wall_with_slot(t == 4 ? 3.2f : 20.0f), nullptr, nullptr);
    scans.push_back(result.scan);
    interiors.push_back(result.interior);
    reports.push_back(result.report);
  }
  const ReviewResult result =
      review(engine::Seq<DepthScan>(scans), engine::Seq<Image>(interiors), engine::Seq<Table>(reports));
  ASSERT_EQ(result.doubtful.rows.size(), 1u);
  EXPECT_EQ(result.doubtful.rows[0].name, "4");
  const double proposed = result.doubtful.rows[0].values[0];
  EXPECT_EQ(area_of(remove_mouth(wall_with_slot(3.2f), nullptr, nullptr, {.threshold_mm = proposed}).interior), 50u);
  EXPECT_NE(result.overrides.find("\"4\": {\"threshold_mm\": "), std::string::npos);
  EXPECT_EQ(result.sheet.width, 8 * 160);
  EXPECT_EQ(result.sheet.height, 2 * 160);
}

TEST(Review, RejectsUnequalCounts) {
  EXPECT_THROW_TEXT(review(engine::Seq<DepthScan>(), engine::Seq<Image>(), engine::Seq<Table>(std::vector<Table>(2))),
                    "scans has 0 frames, interiors 0, reports 2");
}

TEST(Review, RejectsPicturesWithoutPixels) {
  const RemoveMouthResult result = remove_mouth(wall_with_slot(20), nullptr, nullptr);
  const auto review_one = [&](const DepthScan& scan, const Image& interior) {
    return review(engine::Seq<DepthScan>({scan}), engine::Seq<Image>({interior}), engine::Seq<Table>({result.report}));
  };
  EXPECT_THROW_TEXT(
      review_one(result.scan, {64, 48, 1, {}}),
      "interior of frame 0 is 64 x 48 pixels with 0 values, expected 64 x 48 as its scan, one value each");
  DepthScan scan = result.scan;
  scan.picture.pixels.clear();
  EXPECT_THROW_TEXT(review_one(scan, result.interior), "scan of frame 0's picture has 0 bytes, expected 64 x 48 x 1");
}

TEST(Reopen, TakesDepthOutWhereTheInteriorIsWhite) {
  DepthScan scan;
  scan.picture = {3, 1, 1, {0, 0, 0}};
  scan.depth_mm = {5, 6, 7};
  EXPECT_EQ(reopen(scan, {3, 1, 1, {0, 255, 0}}).depth_mm, (std::vector<float>{5, 0, 7}));
  EXPECT_THROW_TEXT(reopen(scan, {2, 1, 1, {0, 255}}), "interior has 2 pixels, the scan 3");
}
