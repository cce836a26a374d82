// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/recover_lost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "nodes/flow/scan_flow.h"
#include "tests/nodes/flow/moving_picture.h"

namespace {

using namespace face;
using namespace face::flow;

constexpr int width = 160, height = 120;
constexpr double fold = 30;  // where the lid's skin begins to stretch

// The opening of an eye in a column, 0 beside it.
double opening(double x) { return std::abs(x - 80) < 32 ? std::sqrt(1 - (x - 80) * (x - 80) / 1024) : 0; }
double upper_lid(double x) { return 62 - 11 * opening(x); }
double lower_lid(double x) { return 62 + 9 * opening(x); }

// Skin with a lid that darkens towards its edge, an eyeball with an iris.
double open_eye(double x, double y) {
  const double skin = 120 + 0.3 * test::pattern(x, y);
  if (opening(x) == 0) return skin;
  if (y < upper_lid(x)) return skin - 70 * std::exp(-(upper_lid(x) - y) / 2);
  if (y > lower_lid(x)) return skin;
  return std::hypot(x - 80, y - 61) < 10 ? 30 : 235;
}

// Shut by the share given: the skin between fold and edge is stretched over the eyeball.
double edge(double x, double shut) { return upper_lid(x) + shut * (lower_lid(x) - upper_lid(x)); }
double shut_eye(double x, double y, double shut) {
  if (opening(x) == 0 || y < fold || y > edge(x, shut)) return open_eye(x, y);
  return open_eye(x, fold + (y - fold) * (upper_lid(x) - fold) / (edge(x, shut) - fold));
}

template <class Look>
FeatureMap drawn(const Look& look) {
  FeatureMap map{width, height, {"grey"}, {}, std::vector<std::uint8_t>(width * height, 1)};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0;  // a pixel sees an area
      for (int k = 0; k < 9; ++k) sum += look(x + (k % 3 - 1) / 3.0, y + (k / 3 - 1) / 3.0);
      map.values.push_back(static_cast<float>(sum / 9));
    }
  return map;
}

ScanFlowOptions with_mismatch(double mismatch) {
  ScanFlowOptions options;
  options.window_px = 7;
  options.search = false;
  options.smoothness = 15;
  options.bend_px = 2;
  options.mismatch = mismatch;
  return options;
}

// Errors of the lid's edge, and of the eyeball, which is below the edge once it is shut; sorted, px.
struct Errors {
  std::vector<double> lid, eyeball;
};
Errors errors_of(const FlowField& flow) {
  Errors errors;
  for (int x = 56; x <= 104; ++x)
    for (int y = 0; y < height; ++y) {
      const Vec2f& d = flow.displacement_px[static_cast<std::size_t>(y * width + x)];
      const auto error = [&](double truth) {
        return std::hypot(static_cast<double>(d[0]), static_cast<double>(d[1]) - truth);
      };
      if (y > upper_lid(x) - 4 && y < upper_lid(x) - 1)
        errors.lid.push_back(error((y - fold) * (lower_lid(x) - fold) / (upper_lid(x) - fold) - (y - fold)));
      if (y > upper_lid(x) + 2 && y < lower_lid(x) - 2) errors.eyeball.push_back(error(lower_lid(x) - y));
    }
  std::sort(errors.lid.begin(), errors.lid.end());
  std::sort(errors.eyeball.begin(), errors.eyeball.end());
  return errors;
}

double median(const std::vector<double>& sorted) { return sorted[sorted.size() / 2]; }

}  // namespace

TEST(RecoverLost, FollowsALidThatShutsOverTheEye) {
  const FeatureMap open = drawn(open_eye), shut = drawn([](double x, double y) { return shut_eye(x, y, 1); });
  const Errors lost = errors_of(scan_flow(open, shut, nullptr, with_mismatch(0)));
  EXPECT_GT(median(lost.lid), 5);
  const Errors found = errors_of(scan_flow(open, shut, nullptr, with_mismatch(15)));
  EXPECT_LE(median(found.lid), 1.5);
  EXPECT_LE(found.lid[found.lid.size() * 9 / 10], 3);
  EXPECT_LE(median(found.eyeball), 1);  // hidden: where the lids meet
  EXPECT_LE(found.eyeball[found.eyeball.size() * 9 / 10], 2);
}

TEST(RecoverLost, LeavesAloneWhatIsNotLost) {
  const test::Motion motion = [](double x, double y) {
    return Vec2f{static_cast<float>(0.04 * (x - 80) - 0.06 * (y - 60)),
                 static_cast<float>(0.06 * (x - 80) - 0.03 * (y - 60))};
  };
  const FeatureMap moved = test::picture(width, height, motion);
  EXPECT_EQ(scan_flow(test::still(), moved, nullptr, with_mismatch(15)).displacement_px,
            scan_flow(test::still(), moved, nullptr, with_mismatch(0)).displacement_px);
}

// Something in front of the face looks like nothing of it.
TEST(RecoverLost, BelievesNothingItDoesNotFind) {
  const FeatureMap open = drawn(open_eye);
  FeatureMap covered = open;
  for (int y = 40; y < 85; ++y)
    for (int x = 50; x < 110; ++x)
      covered.values[static_cast<std::size_t>(y * width + x)] = (x / 2 + y / 2) % 2 ? 255 : 0;
  EXPECT_EQ(scan_flow(open, covered, nullptr, with_mismatch(15)).displacement_px,
            scan_flow(open, covered, nullptr, with_mismatch(0)).displacement_px);
}

TEST(RecoverLost, IsNotToldByTheRadius) {
  FeatureMap open = drawn(open_eye), shut = drawn([](double x, double y) { return shut_eye(x, y, 1); });
  open.names = shut.names = {"radius"};
  EXPECT_EQ(scan_flow(open, shut, nullptr, with_mismatch(15)).displacement_px,
            scan_flow(open, shut, nullptr, with_mismatch(0)).displacement_px);
}

TEST(RecoverLost, AcceptsAPictureTooSmallForALevelBelow) {
  FeatureMap small{20, 20, {"grey"}, std::vector<float>(400, 20), std::vector<std::uint8_t>(400, 1)}, other = small;
  for (std::size_t i = 0; i < 200; ++i) other.values[i] = 240;
  const FlowField flow = scan_flow(small, other, nullptr, with_mismatch(1));
  ASSERT_EQ(flow.displacement_px.size(), 400u);
  for (const Vec2f& d : flow.displacement_px) EXPECT_TRUE(std::isfinite(d[0]) && std::isfinite(d[1]));
}
