// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/fit_key_shapes.h"

#include <gtest/gtest.h>

#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::weights;

// A mouth about (100, 200): width and height.
Landmarks mouth(double width, double height) {
  return {{{"left", 100 - width, 200, true},
           {"right", 100 + width, 200, true},
           {"top", 100, 200 - height, true},
           {"bottom", 100, 200 + 2 * height, true}}};
}

KeyShapes wide_and_open() { return {{{"3", 5, mouth(20, 1)}, {"8", 2, mouth(10, 11)}}}; }

std::vector<Weights> fit(const std::vector<Landmarks>& frames, const Landmarks* neutral,
                         const FitKeyShapesOptions& options = {}) {
  std::vector<Weights> found;
  engine::SeqWriter<Weights> writer([&](const std::string&, Weights weights) { found.push_back(std::move(weights)); });
  fit_key_shapes(engine::Seq<Landmarks>(frames), wide_and_open(), neutral, writer, options);
  return found;
}

TEST(FitKeyShapes, FindsHowMuchOfEveryShapeAFrameHas) {
  const Landmarks neutral = mouth(10, 1);
  const std::vector<Weights> found = fit({neutral, mouth(20, 1), mouth(15, 6), mouth(8, 1)}, &neutral);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(found[0].values[k], 0, 1e-6);
    EXPECT_NEAR(found[1].values[k], k == 0 ? 1 : 0, 1e-6);
    EXPECT_NEAR(found[2].values[k], 0.5, 1e-6);
    EXPECT_NEAR(found[3].values[k], 0, 1e-6);  // narrower than any shape
  }
  FitKeyShapesOptions options;
  options.method = FitMethod::least_squares;
  EXPECT_NEAR(fit({mouth(8, 1)}, &neutral, options)[0].values[0], -0.2, 1e-6);
}

TEST(FitKeyShapes, GivesNoWeightsToFramesWithALostLandmark) {
  const Landmarks neutral = mouth(10, 1);
  Landmarks lost = mouth(20, 1);
  lost.points[2].valid = false;
  const std::vector<Weights> found = fit({lost, mouth(20, 1)}, &neutral);
  EXPECT_TRUE(found[0].values.empty());
  EXPECT_NEAR(found[1].values[0], 1, 1e-6);
}

TEST(FitKeyShapes, CountsAFewLostLandmarksWhereTheyWereLastWhenAsked) {
  const Landmarks neutral = mouth(10, 1);
  Landmarks lost = mouth(20, 1);
  lost.points[2].valid = false;
  FitKeyShapesOptions options;
  options.max_lost = 1;
  EXPECT_NEAR(fit({lost}, &neutral, options)[0].values.at(0), 1, 1e-6);
  lost.points[0].valid = false;
  EXPECT_TRUE(fit({lost}, &neutral, options)[0].values.empty());
}

TEST(FitKeyShapes, CanHoldTheSumOfAbsoluteWeights) {
  FitKeyShapesOptions options;
  options.sum_to_one = true;
  const std::vector<Weights> found = fit({mouth(15, 6)}, nullptr, options);
  EXPECT_NEAR(found[0].values[0] + found[0].values[1], 1, 1e-6);
  EXPECT_NEAR(found[0].values[0], 0.5, 1e-6);
}

TEST(FitKeyShapes, RejectsOtherLandmarks) {
  Landmarks other = mouth(10, 1);
  other.points[1].name = "nose";
  EXPECT_THROW_TEXT(fit({other}, nullptr), "landmark 1 of frame 0 is nose, expected right as in the first key shape");
  other.points.pop_back();
  EXPECT_THROW_TEXT(fit({mouth(1, 1)}, &other), "neutral has 3 landmarks, expected 4 as the first key shape");
}

}  // namespace
