// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/check_camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_throw_text.h"
#include "tests/support/phantom_stream.h"

namespace {

using namespace face;
using namespace face::align;

class Heard : public engine::Progress {
 public:
  void warn(const std::string& text) override { texts.push_back(text); }
  std::vector<std::string> texts;
};

struct Take {
  std::vector<DepthScan> scans;
  std::vector<Landmarks> markers;
};

RigidMotion turned(double yaw, double pitch) {
  RigidMotion m;
  const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
  m.rotation = {cy, sy * sp, sy * cp, 0, cp, -sp, -sy, cy * sp, cy * cp};
  m.translation_mm = {20 * yaw, 0, 0};
  return m;
}

// Speaks, raises its brows, and turns by this many radians.
Take take(double yaw, double pitch) {
  const test::PhantomStream stream;
  Take out;
  for (int t = 0; t < 8; ++t) {
    const auto open = static_cast<float>(0.25 * (1 - std::cos(0.7 * t))), brow = static_cast<float>(t % 3) * 0.2f;
    const auto frame = stream.frame(stream.weights({{"jawOpen", open}, {"browInnerUp", brow}}),
                                    turned(yaw * std::sin(0.9 * t), pitch * std::sin(1.7 * t)), std::to_string(t));
    out.scans.push_back(frame.scan);
    out.markers.push_back(stream.marker_truth(frame));
  }
  return out;
}

const Take& turning() {
  static const Take made = take(0.06, 0.05);
  return made;
}

CheckCameraResult look(Take given, double focal, Heard& heard) {
  for (DepthScan& scan : given.scans) scan.camera.focal_px *= static_cast<float>(focal);
  return check_camera(engine::Seq<DepthScan>(given.scans), engine::Seq<Landmarks>(given.markers), given.scans[0],
                      given.markers[0], {}, heard);
}

TEST(CheckCamera, AgreesWithTheTrueCamera) {
  Heard heard;
  const CheckCameraResult result = look(turning(), 1, heard);
  EXPECT_TRUE(result.told);
  EXPECT_TRUE(result.plausible);
  EXPECT_NEAR(result.stretch_x, 1, 0.12);
  EXPECT_NEAR(result.stretch_y, 1, 0.12);
  EXPECT_TRUE(heard.texts.empty());
  EXPECT_EQ(result.report, "the head's turns agree with fx and fy\n");
}

TEST(CheckCamera, NamesFocalLengthsThatAreWrong) {
  for (const double focal : {0.6, 1.6}) {
    Heard heard;
    const CheckCameraResult result = look(turning(), focal, heard);
    EXPECT_FALSE(result.plausible) << focal;
    EXPECT_NEAR(result.stretch_x / focal, 1, 0.12);
    EXPECT_NEAR(result.stretch_y / focal, 1, 0.12);
    ASSERT_EQ(heard.texts.size(), 1u);
    EXPECT_EQ(heard.texts[0] + "\n", result.report);
  }
}

TEST(CheckCamera, SaysNothingOfAHeadThatHardlyTurns) {
  Heard heard;
  const CheckCameraResult result = look(take(0, 0), 0.6, heard);
  EXPECT_FALSE(result.told);
  EXPECT_TRUE(result.plausible);
  EXPECT_TRUE(heard.texts.empty());
  EXPECT_EQ(result.report, "the head turns too little to tell whether fx and fy are true\n");
}

TEST(CheckCamera, SaysNothingWithoutMarkers) {
  Heard heard;
  Take given = turning();
  for (Landmarks& markers : given.markers) markers.points.clear();
  const CheckCameraResult result = look(given, 1, heard);
  EXPECT_TRUE(result.plausible);
  EXPECT_EQ(result.report, "");
}

TEST(CheckCamera, RejectsUnequalCounts) {
  Heard heard;
  Take given = turning();
  given.markers.pop_back();
  EXPECT_THROW_TEXT(look(given, 1, heard), "there are 8 scans and 7 sets of markers");
}

}  // namespace
