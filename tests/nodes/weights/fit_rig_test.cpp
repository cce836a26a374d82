// SPDX-License-Identifier: Apache-2.0
#include "nodes/weights/fit_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/pose.h"
#include "nodes/types/arkit.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::weights;

// Four vertices; jawOpen moves two down, mouthClose one of these up, mouthSmileLeft a third aside.
Rig rig() {
  Rig made;
  made.neutral.points_mm = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  made.shapes.resize(arkit_count);
  for (std::size_t s = 0; s < arkit_count; ++s) made.shapes[s].name = arkit_names[s];
  made.shapes[arkit_index("jawOpen")] = {"jawOpen", {0, 1}, {{0, -10, 0}, {0, -20, 0}}};
  made.shapes[arkit_index("mouthClose")] = {"mouthClose", {0}, {{0, 10, 0}}};
  made.shapes[arkit_index("mouthSmileLeft")] = {"mouthSmileLeft", {2}, {{6, 0, 0}}};
  return made;
}

struct Fitted {
  std::vector<Weights> frames;
  FitRigResult result;
  float weight(std::size_t frame, const char* name) const { return frames.at(frame).values.at(arkit_index(name)); }
};

Fitted fit(const Rig& head, const std::vector<MeshPoints>& points, double restraint = 1e-9) {
  Fitted found;
  engine::SeqWriter<Weights> writer(
      [&](const std::string&, Weights weights) { found.frames.push_back(std::move(weights)); });
  engine::Progress progress;
  found.result = fit_rig(head, engine::Seq<MeshPoints>(points), writer, {restraint}, progress);
  return found;
}

MeshPoints posed(float jaw, float close, float smile) {
  Weights weights{std::vector<float>(arkit_count, 0.0f)};
  weights.values[arkit_index("jawOpen")] = jaw;
  weights.values[arkit_index("mouthClose")] = close;
  weights.values[arkit_index("mouthSmileLeft")] = smile;
  return {pose_points(rig(), weights)};
}

TEST(FitRig, FindsTheWeightsThatAPoseWasMadeOf) {
  const Fitted found = fit(rig(), {posed(0.3f, 0.2f, 0.9f), posed(0, 0, 0), posed(1, 1, 0)});
  EXPECT_NEAR(found.weight(0, "jawOpen"), 0.3, 1e-5);
  EXPECT_NEAR(found.weight(0, "mouthClose"), 0.2, 1e-5);
  EXPECT_NEAR(found.weight(0, "mouthSmileLeft"), 0.9, 1e-5);
  for (const float weight : found.frames[1].values) EXPECT_EQ(weight, 0);
  EXPECT_NEAR(found.weight(2, "mouthClose"), 1, 1e-5);
  EXPECT_LT(found.result.largest_mm, 1e-3);
  EXPECT_EQ(found.frames[0].values.size(), arkit_count);
}

TEST(FitRig, KeepsWeightsBetween0And1AndTellsWhatIsLeft) {
  const Fitted found = fit(rig(), {posed(-0.5f, 0, 1.5f)});
  EXPECT_EQ(found.weight(0, "jawOpen"), 0);
  EXPECT_EQ(found.weight(0, "mouthSmileLeft"), 1);
  // Vertex 1 stays 10 mm too low, of vertex 0 mouthClose makes up for its 5; vertex 2 lacks 3 mm.
  EXPECT_NEAR(found.weight(0, "mouthClose"), 0.5, 1e-5);
  EXPECT_NEAR(found.result.largest_mm, 10, 1e-4);
  EXPECT_NEAR(found.result.rms_mm, std::sqrt((100 + 9) / 4.0), 1e-4);
}

TEST(FitRig, SharesAMotionBetweenShapesThatDoTheSame) {
  Rig twice = rig();
  twice.shapes[arkit_index("mouthSmileRight")] = {"mouthSmileRight", {2}, {{6, 0, 0}}};
  const Fitted found = fit(twice, {posed(0, 0, 0.8f)}, 1e-4);
  EXPECT_NEAR(found.weight(0, "mouthSmileLeft"), 0.4, 2e-3);
  EXPECT_NEAR(found.weight(0, "mouthSmileRight"), 0.4, 2e-3);
}

// A weight that could change gains nothing by it, one at a bound would only gain beyond it.
TEST(FitRig, FindsTheBestWeightsOfShapesThatOverlap) {
  constexpr double restraint = 1e-3;
  Rig head = rig();
  head.neutral.points_mm.assign(30, {0, 0, 0});
  double squares = 0;
  for (std::size_t s = 0; s < arkit_count; ++s) {
    head.shapes[s] = {std::string(arkit_names[s]), {}, {}};
    for (std::uint32_t v = 0; v < 30; ++v) {
      const double phase = 1.7 * static_cast<double>(s) + 0.9 * v * static_cast<double>(s % 7);
      const Vec3f offset = {static_cast<float>(std::sin(phase)), static_cast<float>(std::cos(2.3 * phase)), 0.5f};
      head.shapes[s].vertices.push_back(v), head.shapes[s].offsets_mm.push_back(offset);
      for (const float value : offset) squares += static_cast<double>(value * value);
    }
  }
  for (int frame = 0; frame < 20; ++frame) {
    MeshPoints points{head.neutral.points_mm};
    for (std::size_t v = 0; v < 30; ++v)
      points.points_mm[v] = {static_cast<float>(8 * std::sin(0.3 * frame + 0.5 * static_cast<double>(v))),
                             static_cast<float>(6 * std::cos(0.7 * frame * static_cast<double>(v))), 3};
    const Weights weights = fit(head, {points}, restraint).frames[0];
    const std::vector<Vec3f> reached = pose_points(head, weights);
    for (std::size_t s = 0; s < arkit_count; ++s) {
      double slope = restraint * squares / arkit_count * static_cast<double>(weights.values[s]);
      for (std::size_t v = 0; v < 30; ++v)
        for (std::size_t d = 0; d < 3; ++d)
          slope += static_cast<double>(head.shapes[s].offsets_mm[v][d] * (reached[v][d] - points.points_mm[v][d]));
      EXPECT_TRUE(slope < 2e-3 || weights.values[s] == 0) << frame << ", " << s << ": " << slope;
      EXPECT_TRUE(slope > -2e-3 || weights.values[s] == 1) << frame << ", " << s << ": " << slope;
    }
  }
}

TEST(FitRig, RepeatsTheLastFrameWhereOneWasLost) {
  const Fitted found = fit(rig(), {MeshPoints{}, posed(0.3f, 0, 0), MeshPoints{}});
  EXPECT_EQ(found.weight(0, "jawOpen"), 0);
  EXPECT_EQ(found.weight(2, "jawOpen"), found.weight(1, "jawOpen"));
  EXPECT_LT(found.result.rms_mm, 1e-3);
}

TEST(FitRig, RefusesWhatIsNoAnimationOfTheRig) {
  EXPECT_THROW_TEXT(fit(rig(), {}), "there are no frames");
  EXPECT_THROW_TEXT(fit(rig(), {MeshPoints{{{0, 0, 0}}}}), "frame 0 has 1 vertices, expected 4 as the rig");
  Rig bare = rig();
  bare.shapes.resize(1);
  EXPECT_THROW_TEXT(fit(bare, {posed(0, 0, 0)}), "the rig has none of the 52 ARKit shapes");
}

}  // namespace
