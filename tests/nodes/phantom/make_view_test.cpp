// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "nodes/phantom/mark_points.h"
#include "nodes/render/camera.h"
#include "tests/support/expect_throw_text.h"

namespace face::phantom {
namespace {

Rig jawed() {
  Rig rig;
  rig.shapes = {{"mouthPucker", {}, {}}, {"jawOpen", {}, {}}};
  return rig;
}

double turn_of(const MakeViewResult& view) {
  return std::atan2(view.world_from_head.rotation[2], view.world_from_head.rotation[0]) * 180 / std::numbers::pi;
}

TEST(MakeView, DrawsTurnsFromTheWholeRangeAndMouthsByTheirShare) {
  double least = 0, most = 0;
  int open = 0;
  for (int i = 0; i < 300; ++i) {
    const std::string id = std::to_string(i);
    const MakeViewResult view = make_view(jawed(), &id);
    least = std::min(least, turn_of(view));
    most = std::max(most, turn_of(view));
    EXPECT_EQ(view.weights.values[0], 0);
    const float jaw = view.weights.values[1];
    open += jaw > 0;
    EXPECT_TRUE(jaw == 0 || (jaw >= 0.15f && jaw <= 0.5f)) << jaw;
  }
  EXPECT_GT(least, -40);
  EXPECT_LT(least, -36);
  EXPECT_GT(most, 36);
  EXPECT_LT(most, 40);
  EXPECT_NEAR(open, 100, 30);  // 8 is one standard deviation
}

TEST(MakeView, ShowsAFaceOfHalfThePicturesHeightFromAnyDistance) {
  for (const double distance_mm : {400.0, 3000.0}) {
    MakeViewOptions options;
    options.nearest_mm = options.farthest_mm = distance_mm;
    const MakeViewResult view = make_view(jawed(), nullptr, options);
    const double height =
        render::project(view.camera, {0, -80, 80}).y_px - render::project(view.camera, {0, 100, 80}).y_px;
    EXPECT_NEAR(height, 240, 3) << distance_mm;
  }
}

TEST(MakeView, OfAnotherIdOrSeedIsAnother) {
  const std::string one = "1", two = "2";
  EXPECT_EQ(turn_of(make_view(jawed(), &one)), turn_of(make_view(jawed(), &one)));
  EXPECT_NE(turn_of(make_view(jawed(), &one)), turn_of(make_view(jawed(), &two)));
  EXPECT_NE(turn_of(make_view(jawed(), &one)), turn_of(make_view(jawed(), &one, {.seed = 2})));
}

TEST(MakeView, RejectsARigThatCannotOpenItsMouthAndACameraInTheFace) {
  EXPECT_THROW_TEXT(make_view({}, nullptr, {.open_share = 1}), "the rig has no shape jawOpen; set open_share to 0");
  EXPECT_THROW_TEXT(make_view({}, nullptr, {.nearest_mm = 100}), "nearest_mm is 100, expected more than 160");
  EXPECT_THROW_TEXT(make_view({}, nullptr, {.nearest_mm = 900, .farthest_mm = 800}),
                    "farthest_mm is 800, expected at least nearest_mm, 900");
}

Landmarks three() { return {{{"a", 10, 20, true}, {"b", 30, 40, false}, {"c", 50, 60, true}}}; }

TEST(MarkPoints, MarksThoseThatAreSeenAndAskedFor) {
  const Landmarks marked = mark_points(three(), nullptr, {.names = {"c", "b"}, .error_px = 0});
  ASSERT_EQ(marked.points.size(), 1u);
  EXPECT_EQ(marked.points[0].name, "c");
  EXPECT_EQ(marked.points[0].x_px, 50);
  EXPECT_EQ(marked.points[0].y_px, 60);
}

TEST(MarkPoints, IsOffByTheErrorAsked) {
  double squares = 0;
  for (int i = 0; i < 500; ++i) {
    const std::string id = std::to_string(i);
    const Landmarks marked = mark_points(three(), &id, {.names = {"a"}, .error_px = 2});
    squares += std::pow(marked.points[0].x_px - 10, 2) + std::pow(marked.points[0].y_px - 20, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / 1000), 2, 0.2);  // 0.045 is one standard deviation
}

TEST(MarkPoints, RejectsANameThatIsNotThere) {
  EXPECT_THROW_TEXT(mark_points(three(), nullptr, {.names = {"d"}}), "there is no point \"d\" among the 3 given");
}

}  // namespace
}  // namespace face::phantom
