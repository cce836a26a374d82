// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/sculpt_keys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "nodes/meshik/blend_linear.h"
#include "nodes/meshik/landmark_vertices.h"
#include "nodes/meshik/transfer_landmarks.h"
#include "tests/nodes/meshik/landmark_rig.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::meshik;

Rig speaking_rig() {
  Rig rig = test::landmark_rig();
  Shape open{"jawOpen", {7, 8, 9, 55, 56, 57, 58, 59}, {}};
  for (std::size_t i = 0; i < 8; ++i) open.offsets_mm.push_back({0, i < 3 ? -20.0f : -16.0f, -3});
  Shape pucker{"mouthPucker", {48, 54}, {{9, 0, 4}, {-9, 0, 4}}};
  Shape blink{"eyeBlinkLeft", {42}, {{0, -5, 0}}};
  rig.shapes = {open, pucker, blink};
  return rig;
}

// The rig's landmarks at these weights, seen by a camera of 0.5 mm per pixel.
Landmarks seen(const Rig& rig, float open, float pucker) {
  std::vector<Vec3f> points = rig.neutral.points_mm;
  for (std::size_t s = 0; s < 2; ++s)
    for (std::size_t i = 0; i < rig.shapes[s].vertices.size(); ++i)
      for (std::size_t d = 0; d < 3; ++d)
        points[rig.shapes[s].vertices[i]][d] += (s == 0 ? open : pucker) * rig.shapes[s].offsets_mm[i][d];
  Landmarks landmarks;
  const auto add = [&](const std::string& name, std::size_t i) {
    landmarks.points.push_back(
        {name, 180 + static_cast<double>(points[i][0]) / 0.5, 200 - static_cast<double>(points[i][1]) / 0.5, true});
  };
  add("eye_inner_r", 39);
  add("eye_inner_l", 42);
  add("nose_tip", 30);
  for (std::size_t i = 0; i < 12; ++i) add("lip_" + std::to_string(i), 48 + i);
  add("jaw_r", 7);
  add("chin", 8);
  add("jaw_l", 9);
  return landmarks;
}

struct Sculpted {
  SculptKeysResult result;
  std::vector<Mesh> meshes;
  std::vector<Weights> weights;
};
Sculpted sculpt(const Rig& rig, const KeyShapes& keys, const Landmarks& neutral, const SculptKeysOptions& options = {},
                const Visemes* visemes = nullptr) {
  Sculpted sculpted;
  engine::SeqWriter<Mesh> meshes([&](const std::string&, Mesh mesh) { sculpted.meshes.push_back(std::move(mesh)); });
  engine::SeqWriter<Weights> weights([&](const std::string&, Weights w) { sculpted.weights.push_back(std::move(w)); });
  sculpted.result = sculpt_keys(rig, keys, neutral, visemes, meshes, weights, options);
  return sculpted;
}

TEST(SculptKeys, FindsTheWeightsThatMadeTheLandmarks) {
  const Rig rig = speaking_rig();
  const KeyShapes keys{{{"1", 1, seen(rig, 0.6f, 0)}, {"2", 1, seen(rig, 0.1f, 0.8f)}}};
  const Sculpted found = sculpt(rig, keys, seen(rig, 0, 0), {1e-9});
  EXPECT_NEAR(found.result.mm_per_px, 0.5, 1e-6);
  EXPECT_NEAR(found.result.rms_mm, 0, 1e-5);
  EXPECT_NEAR(found.weights[0].values[0], 0.6, 1e-5);
  EXPECT_NEAR(found.weights[0].values[1], 0, 1e-5);
  EXPECT_NEAR(found.weights[1].values[1], 0.8, 1e-5);
  EXPECT_EQ(found.weights[1].values[2], 0);  // an eye is no mouth
  EXPECT_NEAR(found.meshes[0].points_mm[57][1], rig.neutral.points_mm[57][1] - 0.6f * 16, 1e-4);
}

TEST(SculptKeys, StaysWithinTheRigsRange) {
  const Rig rig = speaking_rig();
  const Sculpted found = sculpt(rig, {{{"1", 1, seen(rig, 1.7f, -0.5f)}}}, seen(rig, 0, 0));
  EXPECT_EQ(found.weights[0].values[0], 1);
  EXPECT_EQ(found.weights[0].values[1], 0);
  EXPECT_GT(found.result.rms_mm, 1);
}

// jawOpen alone or with mouthPucker, by their places in ARKit's list.
Viseme viseme(float open, float pucker) {
  Viseme out;
  out.label = "AA";
  out.weights.assign(52, 0.0f);
  out.sigmas.assign(52, 1.0f);
  out.weights[17] = open;
  out.weights[20] = pucker;
  return out;
}

TEST(SculptKeys, OfTwoShapesThatLookAlikeTakesTheOneThatSpeechUses) {
  Rig rig = speaking_rig();
  Shape alike = rig.shapes[0];  // moves the landmarks by as much, and something else
  alike.name = "mouthFunnel";
  rig.shapes.insert(rig.shapes.begin(), alike);
  const Landmarks rest = seen(speaking_rig(), 0, 0), open = seen(speaking_rig(), 0.5f, 0);
  const KeyShapes keys{{{"1", 1, open}}};
  const Sculpted plain = sculpt(rig, keys, rest);
  EXPECT_NEAR(plain.weights[0].values[0], plain.weights[0].values[1], 1e-6);
  const Visemes table{{viseme(0.4f, 0), viseme(0.1f, 0.3f)}};
  const Sculpted found = sculpt(rig, keys, rest, {}, &table);
  EXPECT_NEAR(found.weights[0].values[1], 0.5, 0.02);
  EXPECT_LT(found.weights[0].values[0], 0.01);
}

// An F is two of forty phones: where all visemes were one Gaussian, a rolled lip was taken for pressed ones.
TEST(SculptKeys, TakesTheVisemeThatExplainsTheLandmarksAndRollsInALipThatTouchesTheTeeth) {
  Rig rig = speaking_rig();
  Shape roll{"mouthRollLower", {56, 57, 58}, {{0, 6, -5}, {0, 6, -5}, {0, 6, -5}}};
  Shape press{"mouthPressLeft", {50, 51, 52, 56, 57, 58}, {}};
  for (std::size_t i = 0; i < 6; ++i) press.offsets_mm.push_back({0, i < 3 ? -1.0f : 6.0f, 0});
  rig.shapes.push_back(roll);
  rig.shapes.push_back(press);
  Visemes table;
  for (int i = 0; i < 20; ++i) {
    table.visemes.push_back(viseme(0.4f, 0));
    table.visemes.push_back(viseme(0.05f, 0));
    table.visemes.back().weights[35] = 0.3f;  // mouthPressLeft
  }
  table.visemes.push_back(viseme(0.05f, 0));
  table.visemes.back().contact = "teeth";
  const Landmarks rest = seen(rig, 0, 0);
  Landmarks teeth = rest;
  for (Landmark& point : teeth.points)
    if (point.name == "lip_8" || point.name == "lip_9" || point.name == "lip_10") point.y_px -= 0.9 * 6 / 0.5;
  const KeyShapes keys{{{"1", 1, teeth}}};
  const Sculpted found = sculpt(rig, keys, rest, {}, &table);
  EXPECT_NEAR(found.weights[0].values[3], 0.9, 0.05);
  EXPECT_LT(found.weights[0].values[4], 0.05);
  SculptKeysOptions one;
  one.common_share = 1;
  EXPECT_GT(sculpt(rig, keys, rest, one, &table).weights[0].values[4], 0.2);
}

TEST(SculptKeys, DoesNotTakeTheEdgeThatIsSeenOfARolledLipForTheOneThatRolledIn) {
  Rig rig = speaking_rig();
  const Shape roll{"mouthRollLower", {56, 57, 58, 66}, {{0, 6, -5}, {0, 6, -5}, {0, 6, -5}, {0, -4, -6}}};
  rig.shapes.push_back(roll);
  Visemes table;
  table.visemes = {viseme(0.4f, 0), viseme(0.05f, 0)};
  table.visemes.back().contact = "teeth";
  Landmarks rest = seen(rig, 0, 0);
  rest.points.push_back({"inner_lip_2", 180, 200, true});
  rest.points.push_back({"inner_lip_6", 180, 200, true});
  Landmarks teeth = rest;  // what is seen of the inner edge stays where it is
  for (Landmark& point : teeth.points)
    if (point.name == "lip_8" || point.name == "lip_9" || point.name == "lip_10") point.y_px -= 0.9 * 6 / 0.5;
  const KeyShapes keys{{{"1", 1, teeth}}};
  EXPECT_NEAR(sculpt(rig, keys, rest, {}, &table).weights[0].values[3], 0.9, 0.06);
}

TEST(SculptKeys, UsesNoShapeThatMovesNoLandmark) {
  const Rig rig = speaking_rig();
  const Visemes table{{viseme(0.4f, 0.4f)}};
  // The lips' corners are not among these landmarks: what the jaw says decides.
  Landmarks rest = seen(rig, 0, 0), open = seen(rig, 0.4f, 0);
  const auto drop = [](Landmarks& points) {
    std::erase_if(points.points, [](const Landmark& p) { return p.name == "lip_0" || p.name == "lip_6"; });
  };
  drop(rest);
  drop(open);
  const Sculpted found = sculpt(rig, {{{"1", 1, open}}}, rest, {}, &table);
  EXPECT_EQ(found.weights[0].values[1], 0);  // mouthPucker moves none of them: it is not used
  EXPECT_NEAR(found.weights[0].values[0], 0.4, 0.02);
}

TEST(SculptKeys, RejectsVisemesOfAnotherNumberOfShapes) {
  const Rig rig = speaking_rig();
  Visemes table{{viseme(0.4f, 0)}};
  table.visemes[0].weights.pop_back();
  EXPECT_THROW_TEXT(sculpt(rig, {}, seen(rig, 0, 0), {}, &table), "viseme AA has 51 weights, expected 52");
}

TEST(SculptKeys, RejectsARigOrLandmarksThatDoNotFit) {
  Rig rig = speaking_rig();
  Landmarks upside_down = seen(rig, 0, 0);
  for (Landmark& point : upside_down.points) {
    point.x_px *= -1;
    point.y_px *= -1;
  }
  EXPECT_THROW_TEXT(sculpt(rig, {}, upside_down), "the neutral landmarks do not lie as those of an upright face do");
  EXPECT_THROW_TEXT(sculpt(rig, {}, {{{"a", 0, 0, true}}}),
                    "no landmark is called lip_0 to lip_11, jaw_r, chin, jaw_l, eye_inner_r, eye_inner_l or nose_tip");
  rig.landmarks68.clear();
  EXPECT_THROW_TEXT(sculpt(rig, {}, seen(speaking_rig(), 0, 0)),
                    "the rig has 0 landmarks, expected 68, as the embedded head, ICT-FaceKit folders and GLB files "
                    "that were made of these have; transfer.mark_landmarks finds those of another head");
}

TEST(TransferLandmarks, BlendsTheLandmarksOfTheKeyMeshes) {
  const Rig rig = speaking_rig();
  const KeyShapes keys{{{"1", 1, seen(rig, 1, 0)}, {"2", 1, seen(rig, 0, 1)}}};
  const engine::Seq<Mesh> meshes(sculpt(rig, keys, seen(rig, 0, 0), {1e-9}).meshes);
  const VertexTargets targets = transfer_landmarks(rig, meshes, keys, {{0.5f, 0.25f}});
  ASSERT_EQ(targets.targets.size(), 18u);
  for (const VertexTarget& target : targets.targets) {
    EXPECT_FALSE(target.has_z);
    if (target.vertex == 57) {
      EXPECT_NEAR(target.y_mm, -8 - 8, 1e-3);
    }
    if (target.vertex == 48) {
      EXPECT_NEAR(target.x_mm, -25 + 0.25 * 9, 1e-3);
    }
  }
  EXPECT_TRUE(transfer_landmarks(rig, meshes, keys, {}).targets.empty());
  EXPECT_THROW_TEXT(transfer_landmarks(rig, meshes, keys, {{1.0f}}),
                    "there are 1 weights, expected 2, one per key mesh");
}

// Meshes that count how often they are asked for, as if each were read from a disk.
struct CountedMeshes final : engine::SeqSource<Mesh> {
  explicit CountedMeshes(std::vector<Mesh> values) : meshes(std::move(values)), loads(meshes.size(), 0) {}
  std::size_t size() const override { return meshes.size(); }
  std::string id(std::size_t index) const override { return std::to_string(index); }
  std::shared_ptr<const Mesh> load(std::size_t index) const override {
    ++loads[index];
    return std::make_shared<const Mesh>(meshes[index]);
  }
  std::vector<Mesh> meshes;
  mutable std::vector<int> loads;
};

// A film of ten minutes took an hour: a frame read every mesh from the store once per landmark.
TEST(TransferLandmarks, AsksForAKeyMeshOnceAndOnlyWhereItHasWeight) {
  const Rig rig = speaking_rig();
  const KeyShapes keys{{{"1", 1, seen(rig, 1, 0)}, {"2", 1, seen(rig, 0, 1)}}};
  const auto source = std::make_shared<const CountedMeshes>(sculpt(rig, keys, seen(rig, 0, 0)).meshes);
  const double contact = 1;
  transfer_landmarks(rig, engine::Seq<Mesh>(source), keys, {{0.5f, 0}}, &contact);
  EXPECT_EQ(source->loads, (std::vector<int>{1, 0}));
}

// Inner lips that are 0.2 mm apart at rest, and a shape that brings them together.
Rig closing_rig() {
  Rig rig = speaking_rig();
  rig.neutral.points_mm[62] = {0, 0.2f, 0};
  rig.neutral.points_mm[66] = {0, 0, 0};
  rig.inner_lips = {{62, 66}};
  rig.shapes[0].vertices.push_back(66);
  rig.shapes[0].offsets_mm.push_back({0, -15, -3});
  Shape close{"mouthClose", {66}, {{0, 15, 0}}};
  rig.shapes.push_back(close);
  return rig;
}

Landmarks with_inner_lips(Landmarks points, double gap_px) {
  points.points.push_back({"inner_lip_2", 180, 199.6, true});
  points.points.push_back({"inner_lip_6", 180, 200 + gap_px, true});
  return points;
}

TEST(SculptKeys, BelievesWhatIsSeenBetweenTheLipsMoreThanTheirPlaces) {
  Rig rig = closing_rig();
  rig.shapes.resize(1);  // the jaw alone takes the lips apart
  const Landmarks rest = with_inner_lips(seen(speaking_rig(), 0, 0), 0);
  // The outer lips and the chin say that the mouth is open by 3 mm, between the lips there is nothing to be seen.
  const KeyShapes keys{{{"1", 1, with_inner_lips(seen(speaking_rig(), 0.2f, 0), 0)}}};
  double last = 0.2;
  for (const double error_mm : {100.0, 0.2, 0.02}) {
    SculptKeysOptions options;
    options.gap_error_mm = error_mm;
    const Sculpted found = sculpt(rig, keys, rest, options);
    EXPECT_LT(found.weights[0].values[0], last - 0.01) << error_mm;
    last = static_cast<double>(found.weights[0].values[0]);
  }
  EXPECT_LT(last, 0.01);
}

TEST(TransferLandmarks, PartsLipsByLittleWhereTheKeyShapesShowLittle) {
  const Rig rig = closing_rig();
  // Lips that are thicker than any of the rig's: the outer edges of a mouth that is open by 6 mm show 1 mm between
  // them.
  const Landmarks rest = with_inner_lips(seen(rig, 0, 0), 0);
  const double px = 1 / landmark_scale_mm(rig, rest, landmark_vertices(rig, rest));
  const KeyShapes keys{{{"1", 1, with_inner_lips(seen(rig, 0.4f, 0), px)}}};
  const Sculpted open = sculpt(rig, {{{"1", 1, seen(rig, 0.4f, 0)}}}, seen(rig, 0, 0), {1e-9});
  const engine::Seq<Mesh> meshes(open.meshes);
  const auto gap_mm = [](const VertexTargets& targets) {
    double upper = 0, lower = 0;
    for (const VertexTarget& target : targets.targets) {
      if (target.vertex == 62) upper = target.y_mm;
      if (target.vertex == 66) lower = target.y_mm;
    }
    return upper - lower - 0.2;
  };
  const VertexTargets before = transfer_landmarks(rig, meshes, keys, {{1.0f}});
  EXPECT_NEAR(gap_mm(before), 6, 0.1);
  const VertexTargets after = transfer_landmarks(rig, meshes, keys, {{1.0f}}, nullptr, &rest);
  EXPECT_NEAR(gap_mm(after), 6 - 5 / (1 + 1.0 / 16), 0.02);
  for (std::size_t i = 0; i < before.targets.size(); ++i) {
    if (before.targets[i].vertex == 62 || before.targets[i].vertex == 66) continue;
    EXPECT_EQ(before.targets[i].y_mm, after.targets[i].y_mm) << i;
  }
  // A gap of 20 mm is taken from the key mesh.
  const KeyShapes wide{{{"1", 1, with_inner_lips(seen(rig, 0.4f, 0), 20 * px)}}};
  EXPECT_NEAR(gap_mm(transfer_landmarks(rig, meshes, wide, {{1.0f}}, nullptr, &rest)), 6 + 14.0 / 26, 0.1);
  Landmarks fewer = rest;
  fewer.points.pop_back();
  EXPECT_THROW_TEXT(transfer_landmarks(rig, meshes, keys, {{1.0f}}, nullptr, &fewer),
                    "neutral has 19 landmarks, expected 20 as the key shapes");
}

// Rounded lips came out wide, and spread ones narrow.
TEST(TransferLandmarks, MakesTheMouthAsWideAsItIsSeen) {
  const Rig rig = speaking_rig();
  const Landmarks rest = seen(rig, 0, 0);
  const auto width_mm = [](const VertexTargets& targets) {
    double right = 0, left = 0;
    for (const VertexTarget& target : targets.targets) {
      if (target.vertex == 48) right = target.x_mm;
      if (target.vertex == 54) left = target.x_mm;
    }
    return left - right;
  };
  // The corners are 9 mm nearer to each other, those of the key mesh 4.5.
  const KeyShapes keys{{{"1", 1, seen(rig, 0, 0.5f)}}};
  const engine::Seq<Mesh> meshes(sculpt(rig, {{{"1", 1, seen(rig, 0, 0.25f)}}}, rest, {1e-9}).meshes);
  EXPECT_NEAR(width_mm(transfer_landmarks(rig, meshes, keys, {{1.0f}})), 50 - 4.5, 0.01);
  const double sure = 4.5 * 4.5 / (1 + 4.5 * 4.5);
  const VertexTargets targets = transfer_landmarks(rig, meshes, keys, {{1.0f}}, nullptr, &rest);
  EXPECT_NEAR(width_mm(targets), 50 - 4.5 - sure * 4.5, 0.1);
  for (const VertexTarget& target : targets.targets)
    if (target.vertex == 49 || target.vertex == 39) {
      const auto at_rest = static_cast<double>(rig.neutral.points_mm[target.vertex][0]);
      EXPECT_NEAR(target.x_mm, target.vertex == 39 ? at_rest : at_rest * (1 - sure * 4.5 / 50), 0.05);
    }
  // What the frame shows beyond the mixture, which cannot be wider than the rest.
  const Landmarks spread = seen(rig, 0, -0.2f);
  const VertexTargets wide = transfer_landmarks(rig, meshes, keys, {{0.0f}}, nullptr, &rest, &spread);
  EXPECT_NEAR(width_mm(wide), 50 + 3.6, 0.1);
  Landmarks fewer = rest;
  fewer.points.pop_back();
  EXPECT_THROW_TEXT(transfer_landmarks(rig, meshes, keys, {{1.0f}}, nullptr, &rest, &fewer),
                    "frame has 17 landmarks, expected 18 as the key shapes");
}

TEST(TransferLandmarks, BringsLipsThatMeetTogether) {
  const Rig rig = closing_rig();
  const KeyShapes keys{{{"1", 1, seen(rig, 1, 0)}}};
  const engine::Seq<Mesh> meshes(sculpt(rig, keys, seen(rig, 0, 0), {1e-9}).meshes);
  const VertexTargets open = transfer_landmarks(rig, meshes, keys, {{0.2f}});
  const auto y_of = [](const VertexTargets& targets, std::uint32_t vertex) {
    for (const VertexTarget& target : targets.targets)
      if (target.vertex == vertex) return target.y_mm;
    return 1e9;
  };
  double last_mm = 1e9;
  for (const double contact : {0.25, 0.5, 1.0}) {
    const VertexTargets found = transfer_landmarks(rig, meshes, keys, {{0.2f}}, &contact);
    ASSERT_EQ(found.targets.size(), open.targets.size() + 2);  // the inner lips are no landmarks of the 18
    for (std::size_t i = 0; i < open.targets.size(); ++i) EXPECT_EQ(found.targets[i].y_mm, open.targets[i].y_mm) << i;
    const double gap_mm = y_of(found, 62) - y_of(found, 66) - 0.2;
    EXPECT_LT(gap_mm, last_mm);
    last_mm = gap_mm;
  }
  EXPECT_NEAR(last_mm, 0, 1e-6);
  const double none = 0, odd = -0.5;
  EXPECT_EQ(transfer_landmarks(rig, meshes, keys, {{0.2f}}, &none).targets.size(), open.targets.size());
  EXPECT_THROW_TEXT(transfer_landmarks(rig, meshes, keys, {{0.2f}}, &odd), "contact is -0.5, expected 0 to 1");
}

TEST(BlendLinear, MovesEveryVertexInAStraightLine) {
  Mesh reference, example;
  reference.points_mm = {{0, 0, 0}, {1, 2, 3}};
  example.points_mm = {{2, 0, 0}, {1, 2, 7}};
  const MeshPoints found = blend_linear(reference, engine::Seq<Mesh>({example}), {{0.5f}});
  EXPECT_EQ(found.points_mm, (std::vector<Vec3f>{{1, 0, 0}, {1, 2, 5}}));
  EXPECT_THROW_TEXT(blend_linear(reference, engine::Seq<Mesh>({example}), {{0.5f, 1}}),
                    "there are 2 weights, expected at most 1, one per example");
}

}  // namespace
