// SPDX-License-Identifier: Apache-2.0
// Metrics of speech animation on answers worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "nodes/evaluate/jitter.h"
#include "nodes/evaluate/lip_gap.h"
#include "nodes/evaluate/lip_vertex_error.h"
#include "nodes/evaluate/mesh_error.h"
#include "nodes/evaluate/mouth_time_offset.h"
#include "nodes/evaluate/pose_rig.h"
#include "nodes/evaluate/regions.h"
#include "nodes/evaluate/sync.h"
#include "nodes/evaluate/upper_face_dynamics.h"
#include "nodes/phantom/make_head.h"
#include "tests/nodes/evaluate/small_face.h"
#include "tests/nodes/evaluate/table_of.h"
#include "tests/support/expect_throw_text.h"

namespace face::evaluate {
namespace {

using test::cell;
using test::every;
using test::jaw;
using test::jaws;
using test::small_face;
using test::spoken;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

VertexMask mask_of(std::size_t count, std::size_t first, std::size_t last) {
  VertexMask mask;
  mask.on.assign(count, 0);
  for (std::size_t v = first; v <= last; ++v) mask.on[v] = 1;
  return mask;
}

TEST(LipVertexError, IsTheMeanSquareOfTheWorstLipVertex) {
  const Rig rig = small_face();
  // The lower lip is 1 mm off in one frame, 3 mm in the other: (1 + 9) / 2.
  const auto result = lip_vertex_error(rig, jaws({0.1, 0.8}), jaws({0.0, 0.5}), nullptr);
  EXPECT_NEAR(cell(result.table, "lve_mm2"), 5, 1e-5);
  EXPECT_NEAR(cell(result.table, "lip_error_mm"), std::sqrt(5.0), 1e-5);
  EXPECT_NEAR(cell(result.table, "worst_lip_mm"), 2, 1e-5);
  EXPECT_NEAR(cell(result.table, "mve_mm"), 2 * 10.0 / 35, 1e-5);  // 10 of 35 vertices follow the jaw
  EXPECT_NEAR(cell(result.table, "readable_percent"), 50, 1e-9);
  ASSERT_EQ(result.frames.rows.size(), 2u);
  EXPECT_NEAR(result.frames.rows[1].values[0], 3, 1e-5);
}

TEST(LipVertexError, TakesOtherLipsAndAnotherThreshold) {
  const Rig rig = small_face();
  const VertexMask upper = mask_of(35, 10, 14);
  EXPECT_EQ(cell(lip_vertex_error(rig, jaws({0.5}), jaws({0}), &upper).table, "lve_mm2"), 0);
  LipVertexErrorOptions options;
  options.readable_mm = 3.5;
  EXPECT_EQ(cell(lip_vertex_error(rig, jaws({0.1, 0.8}), jaws({0.0, 0.5}), nullptr, options).table, "readable_percent"),
            100);
}

TEST(LipVertexError, GrowsWithTheSquareOfTheScale) {
  Rig rig = small_face();
  const auto lve = [&] {
    return cell(lip_vertex_error(rig, jaws({0.1, 0.8}), jaws({0, 0.5}), nullptr).table, "lve_mm2");
  };
  const double before = lve();
  for (Vec3f& p : rig.neutral.points_mm)
    for (float& c : p) c *= 2;
  for (Shape& shape : rig.shapes)
    for (Vec3f& p : shape.offsets_mm)
      for (float& c : p) c *= 2;
  EXPECT_NEAR(lve(), 4 * before, 1e-4);
}

TEST(LipVertexError, RejectsUnequalCountsNothingAndNumbersThatAreNone) {
  const Rig rig = small_face();
  EXPECT_THROW_TEXT(lip_vertex_error(rig, jaws({0, 1}), jaws({0}), nullptr), "weights has 2 frames, truth has 1");
  EXPECT_THROW_TEXT(lip_vertex_error(rig, jaws({}), jaws({}), nullptr), "weights has no frames to judge");
  EXPECT_THROW_TEXT(lip_vertex_error(rig, jaws({0}), jaws({not_a_number}), nullptr),
                    "truth of frame 0: weight 17 is nan, expected a finite number");
  const VertexMask other = mask_of(3, 0, 0), none = mask_of(35, 1, 0);
  EXPECT_THROW_TEXT(lip_vertex_error(rig, jaws({0}), jaws({0}), &other), "lips has 3 vertices, expected 35");
  EXPECT_THROW_TEXT(lip_vertex_error(rig, jaws({0}), jaws({0}), &none), "lips holds no vertex");
}

TEST(LipVertexError, NamesTheVertexOfARigThatIsNoNumber) {
  Rig rig = small_face();
  rig.neutral.points_mm[3][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW_TEXT(lip_vertex_error(rig, jaws({0}), jaws({0}), nullptr),
                    "the rig, posed for weights of frame 0: vertex 3 has the coordinate nan, expected a finite number");
}

TEST(MeshError, OfPosedWeightsIsThatOfTheWeights) {
  const Rig rig = small_face();
  const engine::Seq<MeshPoints> own({pose_rig(rig, jaw(0.1)), pose_rig(rig, jaw(0.8))});
  const engine::Seq<MeshPoints> truth({pose_rig(rig, jaw(0)), pose_rig(rig, jaw(0.5))});
  EXPECT_EQ(mesh_error(rig, own, truth, nullptr).table.rows[0].values,
            lip_vertex_error(rig, jaws({0.1, 0.8}), jaws({0, 0.5}), nullptr).table.rows[0].values);
  const engine::Seq<MeshPoints> odd({MeshPoints{{{0, 0, 0}}}, MeshPoints{}});
  EXPECT_THROW_TEXT(mesh_error(rig, odd, truth, nullptr), "points of frame 0 has 1 vertices, expected 35");
}

TEST(MeshError, GoesOnAfterALostFrameAndCountsIt) {
  const Rig rig = small_face();
  const engine::Seq<MeshPoints> own({pose_rig(rig, jaw(0.1)), MeshPoints{}, pose_rig(rig, jaw(0.8))});
  const engine::Seq<MeshPoints> truth({pose_rig(rig, jaw(0)), pose_rig(rig, jaw(1)), pose_rig(rig, jaw(0.5))});
  const auto result = mesh_error(rig, own, truth, nullptr);
  EXPECT_NEAR(cell(result.table, "lve_mm2"), 5, 1e-5);  // (1 + 9) / 2
  EXPECT_NEAR(cell(result.table, "readable_percent"), 50, 1e-9);
  EXPECT_EQ(cell(result.table, "lost_frames"), 1);
  ASSERT_EQ(result.frames.rows.size(), 3u);
  EXPECT_EQ(result.frames.rows[1].values[2], 0);
  EXPECT_TRUE(std::isnan(result.frames.rows[1].values[0]));
  EXPECT_NEAR(result.frames.rows[2].values[0], 3, 1e-5);
  const engine::Seq<MeshPoints> none({MeshPoints{}, MeshPoints{}, MeshPoints{}});
  EXPECT_TRUE(std::isnan(cell(mesh_error(rig, none, truth, nullptr).table, "lve_mm2")));
}

TEST(Regions, OfTheEmbeddedHeadTileItsSkin) {
  const Rig head = phantom::make_head();
  std::vector<int> times(head.neutral.points_mm.size(), 0);
  for (const Region& region : face_regions(head)) {
    EXPECT_GT(region.vertices.size(), 20u) << region.name;
    for (const std::uint32_t v : region.vertices) ++times[v];
  }
  for (const std::uint32_t v : skin_vertices(head)) EXPECT_EQ(times[v], 2) << v;  // its region, and all
  for (const std::uint32_t v : lip_vertices(head)) {
    EXPECT_NEAR(head.neutral.points_mm[v][0], 0, 32);
    EXPECT_NEAR(head.neutral.points_mm[v][1], -34, 16);
  }
  for (const std::uint32_t v : upper_face_vertices(head)) EXPECT_GT(head.neutral.points_mm[v][1], 15);
}

TEST(UpperFaceDynamics, IsTheDifferenceOfTheDeviationsOfSquaredMotion) {
  const Rig rig = small_face();
  // |y - n|^2 is 0 and 16 in turn: deviation 8; ours 0 and 4: 2. Half of the chosen vertices move.
  const engine::Seq<Weights> truth({jaw(0, 0), jaw(0, 1)}), own({jaw(0, 0), jaw(0, 0.5)});
  const VertexMask top = mask_of(35, 15, 34);
  const Table table = upper_face_dynamics(rig, own, truth, &top);
  EXPECT_NEAR(cell(table, "fdd_mm2"), 3, 1e-5);
  EXPECT_NEAR(cell(table, "truth_mm2"), 4, 1e-5);
  EXPECT_NEAR(cell(upper_face_dynamics(rig, truth, own, &top), "fdd_mm2"), -3, 1e-5);
  EXPECT_EQ(cell(upper_face_dynamics(rig, truth, truth, &top), "fdd_mm2"), 0);
  EXPECT_THROW_TEXT(upper_face_dynamics(rig, own, truth, nullptr),
                    "the rig has 0 landmarks, expected 68 to know its upper face by: connect upper_face");
}

TEST(MouthTimeOffset, FindsExtremaBetweenSamples) {
  std::vector<double> curve, time_s;
  for (int i = 0; i < 100; ++i) {
    time_s.push_back(0.02 * i);
    curve.push_back(std::sin(2 * std::numbers::pi * (time_s.back() - 0.013)));
  }
  const std::vector<Extremum> found = find_extrema(curve, time_s, 0.5);
  ASSERT_EQ(found.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(found[i].time_s, 0.263 + 0.5 * static_cast<double>(i), 2e-4);
    EXPECT_EQ(found[i].peak, i % 2 == 0);
  }
  EXPECT_TRUE(find_extrema(curve, time_s, 3).empty());
  EXPECT_TRUE(find_extrema({}, {}, 1).empty());
}

engine::Seq<Weights> chewing(double late_s, std::size_t frames) {
  std::vector<double> open;
  for (std::size_t i = 0; i < frames; ++i) {
    const double t = 0.02 * static_cast<double>(i) - late_s;
    open.push_back(0.5 + 0.3 * std::sin(2 * std::numbers::pi * 1.7 * t) * std::cos(0.4 * t));
  }
  return jaws(open);
}

TEST(MouthTimeOffset, OfADelayedAnimationIsTheDelay) {
  const Rig rig = small_face();
  const Timeline timeline = every(0.02, 150);
  const Table late = mouth_time_offset(rig, chewing(0.04, 150), chewing(0, 150), timeline);
  EXPECT_NEAR(cell(late, "opening", "offset_ms"), 40, 0.5);
  EXPECT_NEAR(cell(late, "opening", "late_ms"), 40, 0.5);
  EXPECT_EQ(cell(late, "opening", "missing_percent"), 0);
  EXPECT_NEAR(cell(mouth_time_offset(rig, chewing(-0.03, 150), chewing(0, 150), timeline), "both", "late_ms"), -30,
              0.5);
  EXPECT_EQ(cell(mouth_time_offset(rig, chewing(0, 150), chewing(0, 150), timeline), "both", "offset_ms"), 0);
}

TEST(MouthTimeOffset, TellsAMouthThatKeepsStillAsMissing) {
  const Rig rig = small_face();
  const Table table = mouth_time_offset(rig, jaws(std::vector<double>(150, 0.2)), chewing(0, 150), every(0.02, 150));
  EXPECT_TRUE(std::isnan(cell(table, "both", "offset_ms")));
  EXPECT_EQ(cell(table, "both", "missing_percent"), 100);
  EXPECT_THROW_TEXT(mouth_time_offset(rig, jaws({0, 1}), jaws({0, 1}), every(0.02, 3)),
                    "weights has 2 frames, timeline has 3");
}

TEST(LipGap, JudgesClosuresByTheirLeastGapAndItsTime) {
  const Rig rig = small_face();
  // 10 frames per second; M from 0.2 to 0.4 s has its least gap, 3 mm, at 0.3 s; B from 0.6 to 0.9 s shuts at 0.7 s.
  const auto own = jaws({0.5, 0.5, 0.5, 0.3, 0.5, 0.5, 0.5, 0.0, 0.5, 0.5, 0.5});
  const Phones phones = spoken({{"SIL", 0.2}, {"M", 0.4}, {"AA", 0.6}, {"B", 0.9}, {"SIL", 1.0}});
  const LipGapResult result = lip_gap(rig, own, nullptr, phones, every(0.1, 11));
  EXPECT_EQ(cell(result.table, "own", "closures"), 2);
  EXPECT_EQ(cell(result.table, "own", "closure_percent"), 50);
  EXPECT_NEAR(cell(result.table, "own", "closure_error_mm"), 1, 1e-5);   // (3 - 1 + 0) / 2
  EXPECT_NEAR(cell(result.table, "own", "closure_late_ms"), -25, 1e-6);  // 0 and -50
  EXPECT_NEAR(cell(result.table, "own", "closure_offset_ms"), 25, 1e-6);
  EXPECT_EQ(cell(result.table, "own", "false_closed_percent"), 0);
  EXPECT_EQ(cell(result.table, "own", "open_vowels"), 1);
  EXPECT_EQ(cell(result.table, "own", "penetration_mm"), 0);
  EXPECT_TRUE(std::isnan(cell(result.table, "own", "contact_percent")));
  EXPECT_TRUE(std::isnan(cell(result.table, "own", "gap_error_mm")));
  EXPECT_NEAR(result.frames.rows[3].values[0], 3, 1e-5);
}

TEST(LipGap, TellsLipsThatRunIntoEachOtherAndVowelsThatAreShut) {
  const Rig rig = small_face();
  const Phones phones = spoken({{"AA", 0.4}, {"P.c", 0.6}, {"P.r", 0.7}});
  const auto truth = jaws({0.5, 0.5, 0.5, 0.5, 0.5, 0, 0.5, 0.5});
  const LipGapResult result = lip_gap(rig, jaws({0, 0, 0, 0, 0, -0.4, 0, 0}), &truth, phones, every(0.1, 8));
  EXPECT_EQ(cell(result.table, "own", "false_closed_percent"), 100);
  EXPECT_EQ(cell(result.table, "truth", "false_closed_percent"), 0);
  EXPECT_NEAR(cell(result.table, "own", "penetration_mm"), 0.5, 1e-5);
  EXPECT_NEAR(cell(result.table, "own", "deepest_mm"), 4, 1e-5);
  EXPECT_NEAR(cell(result.table, "own", "closure_late_ms"), 0, 1e-6);
  EXPECT_EQ(cell(result.table, "truth", "closure_percent"), 100);
  EXPECT_NEAR(cell(result.table, "own", "gap_error_mm"), std::sqrt((7 * 25 + 16) / 8.0), 1e-5);
}

TEST(LipGap, SeesAShortClosureBetweenTwoFrames) {
  const Rig rig = small_face();
  const Phones phones = spoken({{"SIL", 0.24}, {"P.c", 0.26}, {"SIL", 0.4}});
  const LipGapResult result = lip_gap(rig, jaws({0.5, 0.5, 0.1, 0.05, 0.5}), nullptr, phones, every(0.1, 5));
  EXPECT_EQ(cell(result.table, "own", "closures"), 1);
  EXPECT_EQ(cell(result.table, "own", "closure_percent"), 100);  // 0.7 mm by interpolation
}

TEST(LipGap, RejectsWrongInput) {
  const Rig rig = small_face();
  const auto truth = jaws({0});
  EXPECT_THROW_TEXT(lip_gap(rig, jaws({0, 0}), &truth, {}, every(0.1, 2)), "weights has 2 frames, truth has 1");
  EXPECT_THROW_TEXT(lip_gap(rig, jaws({0}), nullptr, spoken({{"M", not_a_number}}), every(0.1, 1)),
                    "phone 0 (M) lasts from 0 to nan s, expected an ascending finite pair");
  Rig other = rig;
  other.inner_lips.clear();
  EXPECT_THROW_TEXT(lip_gap(other, jaws({0}), nullptr, {}, every(0.1, 1)),
                    "the rig names no inner lip pairs, so its lip gap cannot be measured");
}

TEST(Jitter, OfAKnownTrembleIsItsSize) {
  // One vertex, 1 mm left and right in turn, 30 frames per second: all power at 15 Hz, second differences of 4 mm.
  std::vector<MeshPoints> frames;
  for (int t = 0; t < 60; ++t) frames.push_back({{{t % 2 ? 1.0f : -1.0f, 0, 0}}});
  const Table table = jitter(engine::Seq<MeshPoints>(frames), nullptr, every(1 / 30.0, 60), nullptr, nullptr);
  EXPECT_NEAR(cell(table, "own", "spread_mm"), 1, 1e-9);
  EXPECT_NEAR(cell(table, "own", "jerk_mm"), 4, 1e-9);
  EXPECT_NEAR(cell(table, "own", "high_percent"), 100, 1e-6);
}

TEST(Jitter, TellsAnOverSmoothedAnimationByItsRatio) {
  std::vector<MeshPoints> truth, own, moved;
  for (int t = 0; t < 120; ++t) {
    const auto slow = static_cast<float>(std::sin(2 * std::numbers::pi * t / 30));
    const auto fast = static_cast<float>(0.5 * std::sin(2 * std::numbers::pi * t / 2.4));
    truth.push_back({{{slow + fast, 0, 0}}});
    own.push_back({{{slow, 0, 0}}});
    moved.push_back({{{slow + fast + 100, 7, 0}}});
  }
  const engine::Seq<MeshPoints> real(truth);
  const Timeline timeline = every(1 / 30.0, 120);
  const Table smooth = jitter(engine::Seq<MeshPoints>(own), &real, timeline, nullptr, nullptr);
  EXPECT_NEAR(cell(smooth, "truth", "high_percent"), 20, 0.5);  // 0.25 of 1.25; the window smears a little
  EXPECT_LT(cell(smooth, "ratio", "high_percent"), 0.01);
  const Table same = jitter(engine::Seq<MeshPoints>(moved), &real, timeline, nullptr, nullptr);
  EXPECT_NEAR(cell(same, "ratio", "high_percent"), 1, 1e-3);  // wherever it is
  EXPECT_NEAR(cell(same, "ratio", "jerk_mm"), 1, 1e-4);
}

TEST(Jitter, LooksAtTheLandmarksOfARigUnlessOtherVerticesAreGiven) {
  Rig rig = small_face();
  rig.landmarks68.assign(68, 20);  // which the jaw leaves alone
  std::vector<MeshPoints> frames;
  for (int t = 0; t < 10; ++t) frames.push_back(pose_rig(rig, jaw(t % 2)));
  const engine::Seq<MeshPoints> points(frames);
  const VertexMask lower = mask_of(35, 5, 9);
  EXPECT_EQ(cell(jitter(points, nullptr, every(0.1, 10), &rig, nullptr), "own", "jerk_mm"), 0);
  EXPECT_NEAR(cell(jitter(points, nullptr, every(0.1, 10), &rig, &lower), "own", "jerk_mm"), 20, 1e-4);
}

TEST(Jitter, OfOneFrameIsNotMeasured) {
  const Table table =
      jitter(engine::Seq<MeshPoints>({MeshPoints{{{1, 2, 3}}}}), nullptr, every(0.1, 1), nullptr, nullptr);
  EXPECT_EQ(cell(table, "own", "spread_mm"), 0);
  EXPECT_TRUE(std::isnan(cell(table, "own", "jerk_mm")));
  EXPECT_TRUE(std::isnan(cell(table, "own", "high_percent")));
  const auto bad = static_cast<float>(not_a_number);
  EXPECT_THROW_TEXT(
      jitter(engine::Seq<MeshPoints>({MeshPoints{{{1, bad, 3}}}}), nullptr, every(0.1, 1), nullptr, nullptr),
      "points of frame 0: vertex 0 has the coordinate nan, expected a finite number");
}

TEST(Sync, ComparesTheOnsetOfSoundWithTheFirstMovement) {
  Audio audio;
  for (int i = 0; i < 16000; ++i) audio.samples.push_back(i < 8000 ? 0.001f * static_cast<float>(i % 2) : 0.5f);
  const Timeline timeline = every(0.04, 25);
  std::vector<double> open(25, 0.0);
  for (std::size_t i = 10; i < 25; ++i) open[i] = 0.3;
  const Table table = sync(audio, jaws(open), timeline);
  EXPECT_NEAR(cell(table, "audio_onset_s"), 0.5, 1e-9);
  EXPECT_NEAR(cell(table, "first_move_s"), 0.4, 1e-9);
  EXPECT_NEAR(cell(table, "late_ms"), -100, 1e-6);
  EXPECT_NEAR(cell(table, "sync_ms"), 100, 1e-6);
  EXPECT_TRUE(std::isnan(cell(sync(Audio{}, jaws(open), timeline), "late_ms")));
  EXPECT_TRUE(std::isnan(cell(sync(audio, jaws(std::vector<double>(25, 0.1)), timeline), "first_move_s")));
  const engine::Seq<Weights> blink({jaw(0, 0), jaw(0, 1)});
  EXPECT_TRUE(std::isnan(cell(sync(audio, blink, every(0.04, 2)), "first_move_s")));  // brows do not speak
}

}  // namespace
}  // namespace face::evaluate
