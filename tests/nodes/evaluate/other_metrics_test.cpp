// SPDX-License-Identifier: Apache-2.0
// Metrics of tracking, alignment, flow, pictures and groups on answers worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nodes/evaluate/clustering.h"
#include "nodes/evaluate/correspondence.h"
#include "nodes/evaluate/flow.h"
#include "nodes/evaluate/landmarks.h"
#include "nodes/evaluate/phone_boundaries.h"
#include "nodes/evaluate/picture.h"
#include "nodes/evaluate/pose.h"
#include "nodes/evaluate/statistics.h"
#include "nodes/evaluate/texture_consistency.h"
#include "tests/nodes/evaluate/small_face.h"
#include "tests/nodes/evaluate/table_of.h"
#include "tests/support/expect_throw_text.h"

namespace face::evaluate {
namespace {

using test::cell;
using test::spoken;
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

TEST(Statistics, AreThoseOfNumpy) {
  EXPECT_DOUBLE_EQ(deviation_of({1, 3}), 1);
  EXPECT_DOUBLE_EQ(rms_of({3, 4}), std::sqrt(12.5));
  EXPECT_TRUE(std::isnan(mean_of({})) && std::isnan(rms_of({})));
  EXPECT_TRUE(std::isnan(percent_within({}, 1)));
}

Landmarks points(double shift, bool nose_valid = true) {
  return {{{"36", 100 + shift, 50, true}, {"45", 200 + shift, 50, true}, {"30", 150 + shift, 90, nose_valid}}};
}

TEST(LandmarkErrors, AreInPixelsAndInEyeDistances) {
  const engine::Seq<Landmarks> truth({points(0), points(0)});
  const LandmarksResult result = landmarks(engine::Seq<Landmarks>({points(5), points(20)}), truth);
  EXPECT_NEAR(cell(result.table, "nme_percent"), 12.5, 1e-9);
  EXPECT_NEAR(cell(result.table, "failure_percent"), 50, 1e-9);
  EXPECT_NEAR(cell(result.table, "auc_percent"), 25, 1e-9);  // one frame is right from half the range on
  EXPECT_NEAR(cell(result.table, "rms_px"), std::sqrt(212.5), 1e-9);
  EXPECT_EQ(cell(result.table, "lost_per_1000"), 0);
  EXPECT_NEAR(result.frames.rows[1].values[0], 20, 1e-9);
}

TEST(LandmarkErrors, DoNotChangeWithTheSizeOfThePicture) {
  const auto nme = [](double scale) {
    Landmarks own = points(3), truth = points(0);
    for (Landmarks* l : {&own, &truth})
      for (Landmark& p : l->points) p.x_px *= scale, p.y_px *= scale;
    return cell(landmarks(engine::Seq<Landmarks>({own}), engine::Seq<Landmarks>({truth})).table, "nme_percent");
  };
  EXPECT_NEAR(nme(1), nme(7), 1e-9);
}

TEST(LandmarkErrors, CountLostPoints) {
  const engine::Seq<Landmarks> truth({points(0), points(0)});
  const LandmarksResult result = landmarks(engine::Seq<Landmarks>({points(0, false), Landmarks{}}), truth);
  EXPECT_NEAR(cell(result.table, "lost_per_1000"), 1000 * 4 / 6.0, 1e-9);
  EXPECT_NEAR(cell(result.table, "lost_per_1000_frames"), 2000, 1e-9);
  EXPECT_EQ(cell(result.table, "failure_percent"), 50);
  EXPECT_EQ(cell(result.table, "nme_percent"), 0);  // of the frame that has points
}

TEST(LandmarkErrors, NeedEyesForTheNmeAlone) {
  LandmarksOptions options;
  options.left_corner = "eye";
  const LandmarksResult result =
      landmarks(engine::Seq<Landmarks>({points(2)}), engine::Seq<Landmarks>({points(0)}), options);
  EXPECT_TRUE(std::isnan(cell(result.table, "nme_percent")));
  EXPECT_NEAR(cell(result.table, "rms_px"), 2, 1e-9);
  EXPECT_THROW_TEXT(landmarks({}, {}), "track has no frames to judge");
  EXPECT_THROW_TEXT(landmarks(engine::Seq<Landmarks>({points(not_a_number)}), engine::Seq<Landmarks>({points(0)})),
                    "track of frame 0: point 36 is at nan, 50, expected finite numbers");
}

TEST(PhoneBoundaries, OfShiftedBoundariesAreTheirShifts) {
  const Phones truth = spoken({{"SIL", 0.1}, {"AA", 0.2}, {"M", 0.3}, {"SIL", 0.4}});
  const Phones own = spoken({{"SIL", 0.11}, {"AA", 0.185}, {"M", 0.36}, {"SIL", 0.4}});
  const Table table = phone_boundaries(own, truth);
  EXPECT_EQ(cell(table, "boundaries"), 3);
  EXPECT_NEAR(cell(table, "mae_ms"), 85 / 3.0, 1e-9);
  EXPECT_NEAR(cell(table, "median_ms"), 15, 1e-9);
  EXPECT_NEAR(cell(table, "bias_ms"), 55 / 3.0, 1e-9);
  EXPECT_NEAR(cell(table, "within_10ms_percent"), 100 / 3.0, 1e-9);
  EXPECT_NEAR(cell(table, "within_20ms_percent"), 200 / 3.0, 1e-9);
  EXPECT_NEAR(cell(table, "within_50ms_percent"), 200 / 3.0, 1e-9);
  EXPECT_NEAR(cell(table, "f1_20ms_percent"), 200 / 3.0, 1e-9);
  EXPECT_EQ(cell(table, "per_percent"), 0);
  EXPECT_EQ(cell(table, "unmatched_percent"), 0);
}

TEST(PhoneBoundaries, OfEqualAlignmentsArePerfect) {
  const Phones truth = spoken({{"SIL", 0.1}, {"AA", 0.2}, {"P.c", 0.3}, {"P.r", 0.32}, {"SIL", 0.4}});
  const Table table = phone_boundaries(truth, truth);
  EXPECT_EQ(cell(table, "boundaries"), 4);
  EXPECT_EQ(cell(table, "mae_ms"), 0);
  EXPECT_EQ(cell(table, "f1_20ms_percent"), 100);
  EXPECT_EQ(cell(table, "r_value"), 1);
}

TEST(PhoneBoundaries, GainNothingByLeavingPhonesOut) {
  const Phones truth = spoken({{"SIL", 0.1}, {"AA", 0.2}, {"M", 0.3}, {"IY", 0.4}, {"SIL", 0.5}});
  const Table left_out = phone_boundaries(spoken({{"SIL", 0.1}, {"AA", 0.25}, {"IY", 0.4}, {"SIL", 0.5}}), truth);
  EXPECT_EQ(cell(left_out, "boundaries"), 2);  // SIL-AA and IY-SIL
  EXPECT_EQ(cell(left_out, "unmatched_percent"), 50);
  EXPECT_NEAR(cell(left_out, "per_percent"), 100 / 3.0, 1e-9);
  const Table wrong =
      phone_boundaries(spoken({{"SIL", 0.1}, {"AA", 0.2}, {"N", 0.3}, {"IY", 0.4}, {"SIL", 0.5}}), truth);
  EXPECT_EQ(cell(wrong, "boundaries"), 2);
  EXPECT_NEAR(cell(wrong, "per_percent"), 100 / 3.0, 1e-9);
  EXPECT_EQ(cell(wrong, "f1_20ms_percent"), 100);  // by time alone
}

TEST(PhoneBoundaries, CountNoneBetweenPhonesThatAnotherParts) {
  const Phones truth = spoken({{"SIL", 0.1}, {"AA", 0.2}, {"M", 0.3}, {"SIL", 0.5}});
  const Table table =
      phone_boundaries(spoken({{"SIL", 0.1}, {"AA", 0.2}, {"T", 0.23}, {"M", 0.3}, {"SIL", 0.5}}), truth);
  EXPECT_EQ(cell(table, "boundaries"), 2);
  EXPECT_EQ(cell(table, "per_percent"), 50);  // one insertion, two phones
}

TEST(PhoneBoundaries, JoinSplitStopsWhereTheOtherHasWholeOnes) {
  const Phones whole = spoken({{"AA", 0.1}, {"P", 0.2}, {"SIL", 0.4}});
  const Phones split = spoken({{"AA", 0.1}, {"P.c", 0.17}, {"P.r", 0.2}, {"SIL", 0.4}});
  for (const Table& table : {phone_boundaries(split, whole), phone_boundaries(whole, split)}) {
    EXPECT_EQ(cell(table, "boundaries"), 2);
    EXPECT_EQ(cell(table, "mae_ms"), 0);
    EXPECT_EQ(cell(table, "per_percent"), 0);
  }
}

TEST(PhoneBoundaries, ThatAreTooManyLowerTheRValue) {
  const Phones truth = spoken({{"A", 0.1}, {"B", 0.2}, {"C", 0.3}});
  const Phones twice = spoken({{"A", 0.05}, {"X", 0.1}, {"X", 0.15}, {"B", 0.2}, {"C", 0.3}});
  const Table table = phone_boundaries(twice, truth);
  // Both are hit (HR 1) by twice as many (OS 1): r1 = 1, r2 = -1 / sqrt 2.
  EXPECT_NEAR(cell(table, "r_value"), 1 - (1 + 1 / std::sqrt(2.0)) / 2, 1e-12);
  EXPECT_NEAR(cell(table, "f1_20ms_percent"), 200 / 3.0, 1e-9);
  EXPECT_THROW_TEXT(phone_boundaries({}, truth), "phones has no phones to judge");
  EXPECT_TRUE(std::isnan(cell(phone_boundaries(spoken({{"A", 1}}), spoken({{"A", 1}})), "mae_ms")));
}

TEST(Correspondence, TakesOutARigidMotionAndNothingElse) {
  const Rig rig = test::small_face();
  MeshPoints truth{rig.neutral.points_mm}, own;
  for (const Vec3f& p : truth.points_mm) own.points_mm.push_back({-p[1] + 30, p[0] - 5, p[2] + 8});  // a quarter turn
  const CorrespondenceResult moved = correspondence(rig, own, truth, nullptr);
  EXPECT_NEAR(cell(moved.table, "max_mm"), 0, 1e-4);
  EXPECT_NEAR(moved.truth_from_points.rotation[1], 1, 1e-6);
  for (Vec3f& p : own.points_mm)
    for (float& c : p) c *= 2;
  EXPECT_GT(cell(correspondence(rig, own, truth, nullptr).table, "mean_mm"), 5);  // size is not taken out
}

TEST(Correspondence, DoesNotTakeAMirrorImageForAMotion) {
  const Rig rig = test::small_face();
  MeshPoints truth{rig.neutral.points_mm}, own;
  for (std::size_t v = 0; v < 35; ++v) truth.points_mm[v][2] = 0.3f * truth.points_mm[v][0] * static_cast<float>(v % 4);
  for (const Vec3f& p : truth.points_mm) own.points_mm.push_back({-p[0], p[1], p[2]});
  const CorrespondenceResult result = correspondence(rig, own, truth, nullptr);
  EXPECT_GT(cell(result.table, "mean_mm"), 1);
  const auto& r = result.truth_from_points.rotation;
  EXPECT_NEAR(
      r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6]), 1,
      1e-9);
}

TEST(Correspondence, TellsVerticesThatSlide) {
  const Rig rig = test::small_face();
  const MeshPoints truth{rig.neutral.points_mm};
  MeshPoints own = truth;
  for (std::size_t v = 5; v < 10; ++v) own.points_mm[v][0] += 3;  // along the plane: no surface distance sees it
  const Table table = correspondence(rig, own, truth, nullptr).table;
  EXPECT_NEAR(cell(table, "mean_mm"), 3 * 5 / 35.0, 1e-5);
  EXPECT_NEAR(cell(table, "p95_mm"), 3, 1e-5);
  EXPECT_NEAR(cell(table, "median_mm"), 0, 1e-5);
  VertexMask two;
  two.on.assign(35, 0);
  two.on[0] = two.on[1] = 1;
  EXPECT_THROW_TEXT(correspondence(rig, own, truth, &two), "rigid has 2 vertices, expected at least 3");
  EXPECT_THROW_TEXT(correspondence(rig, {}, truth, nullptr), "points of frame 0 has 0 vertices, expected 35");
}

FlowField constant_flow(float dx, float dy, int width = 4, int height = 3) {
  FlowField flow{width, height, {}, {}};
  flow.displacement_px.assign(static_cast<std::size_t>(width * height), {dx, dy});
  flow.valid.assign(static_cast<std::size_t>(width * height), 1);
  return flow;
}

TEST(FlowErrors, AreDistancesOfEndPoints) {
  FlowField own = constant_flow(3, 4);
  own.valid[0] = 0;
  own.displacement_px[1] = {0, 0};
  const FlowResult result = flow(engine::Seq<FlowField>({own}), engine::Seq<FlowField>({constant_flow(0, 0)}));
  EXPECT_NEAR(cell(result.table, "epe_mean_px"), 50 / 11.0, 1e-9);
  EXPECT_NEAR(cell(result.table, "epe_p95_px"), 5, 0.011);  // a bin
  EXPECT_NEAR(cell(result.table, "over_1px_percent"), 1000 / 11.0, 1e-9);
  EXPECT_NEAR(cell(result.table, "valid_percent"), 1100 / 12.0, 1e-9);
  EXPECT_NEAR(result.frames.rows[0].values[1], 5, 1e-9);
}

TEST(FlowErrors, LeaveOutWhatTheTruthDoesNotKnow) {
  FlowField truth = constant_flow(0, 0);
  truth.displacement_px[5] = {not_a_number, 0};
  truth.valid[5] = 0;
  const FlowResult result = flow(engine::Seq<FlowField>({constant_flow(0, 0)}), engine::Seq<FlowField>({truth}));
  EXPECT_EQ(cell(result.table, "epe_mean_px"), 0);
  truth.valid[5] = 1;
  EXPECT_THROW_TEXT(flow(engine::Seq<FlowField>({constant_flow(0, 0)}), engine::Seq<FlowField>({truth})),
                    "truth of frame 0: valid pixel 5 has no finite displacement");
  EXPECT_THROW_TEXT(
      flow(engine::Seq<FlowField>({constant_flow(0, 0, 3, 3)}), engine::Seq<FlowField>({constant_flow(0, 0)})),
      "flow of frame 0 is 3 x 3, truth is 4 x 3");
  truth.valid.assign(12, 0);
  EXPECT_TRUE(std::isnan(
      cell(flow(engine::Seq<FlowField>({constant_flow(0, 0)}), engine::Seq<FlowField>({truth})).table, "epe_mean_px")));
}

Image grey(int width, int height, int (*value)(int, int)) {
  Image image{width, height, 1, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.pixels.push_back(static_cast<std::uint8_t>(value(x, y)));
  return image;
}

TEST(Picture, MeasuresDifferenceAndSharpness) {
  const Image truth = grey(8, 6, [](int x, int) { return 100 + 10 * x; });
  const Image flat = grey(8, 6, [](int x, int) { return 100 + 5 * x; });
  const Image lighter = grey(8, 6, [](int x, int) { return 110 + 10 * x; });
  const Table sharp = picture(lighter, truth, nullptr);
  EXPECT_NEAR(cell(sharp, "rms_levels"), 10, 1e-9);
  EXPECT_NEAR(cell(sharp, "psnr_db"), 20 * std::log10(25.5), 1e-9);
  EXPECT_NEAR(cell(sharp, "gradient_ratio"), 1, 1e-9);
  EXPECT_NEAR(cell(picture(flat, truth, nullptr), "gradient_ratio"), 0.25, 1e-9);
  EXPECT_TRUE(std::isinf(cell(picture(truth, truth, nullptr), "psnr_db")));
}

TEST(Picture, LooksAtTheMaskAlone) {
  const Image truth = grey(8, 6, [](int x, int) { return 10 * x; });
  const Image own = grey(8, 6, [](int x, int) { return x < 4 ? 10 * x + 6 : 0; });
  const Image left = grey(8, 6, [](int x, int) { return x < 4 ? 255 : 0; });
  const Image none = grey(8, 6, [](int, int) { return 0; });
  EXPECT_NEAR(cell(picture(own, truth, &left), "rms_levels"), 6, 1e-9);
  EXPECT_EQ(cell(picture(own, truth, &left), "pixels"), 24);
  EXPECT_TRUE(std::isnan(cell(picture(own, truth, &none), "psnr_db")));
  const Image other = grey(7, 6, [](int, int) { return 0; });
  EXPECT_THROW_TEXT(picture(own, other, nullptr), "picture is 8 x 6, truth is 7 x 6");
  EXPECT_THROW_TEXT(picture(own, truth, &other), "mask is 7 x 6, truth is 8 x 6");
}

TEST(TextureConsistency, PoolsAllPixelsOfAllFrames) {
  const Image seen = grey(8, 6, [](int, int) { return 100; });
  const Image off3 = grey(8, 6, [](int, int) { return 103; });
  const Image off4 = grey(8, 6, [](int, int) { return 104; });
  const auto result = texture_consistency(engine::Seq<Image>({off3, off4}), engine::Seq<Image>({seen, seen}), nullptr);
  EXPECT_NEAR(cell(result.table, "rms_levels"), std::sqrt(12.5), 1e-9);
  EXPECT_NEAR(cell(result.table, "worst_levels"), 4, 1e-9);
  const Image all = grey(8, 6, [](int, int) { return 255; }), none = grey(8, 6, [](int, int) { return 0; });
  const engine::Seq<Image> masks({all, none});
  const auto masked = texture_consistency(engine::Seq<Image>({off3, off4}), engine::Seq<Image>({seen, seen}), &masks);
  EXPECT_NEAR(cell(masked.table, "rms_levels"), 3, 1e-9);
  EXPECT_TRUE(std::isnan(masked.frames.rows[1].values[0]));
  EXPECT_THROW_TEXT(texture_consistency({}, {}, nullptr), "rendered has no frames to judge");
}

Matrix column(std::vector<double> values) { return {values.size(), 1, values}; }

TEST(Clustering, CountsDistancesExemplarsAndPlantedGroups) {
  const Matrix points = column({0, 1, 2, 10, 11, 50});
  const Matrix labels = column({0, 0, 0, 1, 1, 1}), exemplars = column({1, 3}), planted = column({7, 7, 7, 8, 8, 9});
  ClusteringOptions options;
  options.small = 2;
  const Table table = clustering(points, labels, exemplars, &planted, -5, options);
  EXPECT_DOUBLE_EQ(cell(table, "net_similarity"), -(1 + 1 + 1 + 1600) - 10);
  EXPECT_EQ(cell(table, "small_groups"), 2);
  EXPECT_NEAR(cell(table, "recall_percent"), 200 / 3.0, 1e-9);  // 7 wholly, 8 as two of three, 9 is swallowed
  EXPECT_EQ(cell(table, "small_recall_percent"), 50);
  EXPECT_EQ(cell(table, "exemplar_recall_percent"), 50);
  EXPECT_TRUE(std::isnan(cell(clustering(points, labels, exemplars, nullptr, -5), "recall_percent")));
}

TEST(Clustering, DoesNotCareHowGroupsAreNumbered) {
  const Matrix points = column({0, 1, 2, 10, 11, 50}), planted = column({7, 7, 7, 8, 8, 9});
  const Matrix other_names = column({-1, -1, -1, 400, 400, 3});
  EXPECT_EQ(clustering(points, column({0, 0, 0, 1, 1, 1}), column({1, 3}), &planted, -5).rows[0].values,
            clustering(points, column({1, 1, 1, 0, 0, 0}), column({3, 1}), &other_names, -5).rows[0].values);
}

TEST(Clustering, RejectsWhatDoesNotBelongTogether) {
  const Matrix points = column({0, 1, 2});
  EXPECT_THROW_TEXT(clustering(points, column({0, 0}), column({1}), nullptr, -1), "labels is 2 x 1, expected 3 x 1");
  EXPECT_THROW_TEXT(clustering(points, column({0, 0, 1}), column({1}), nullptr, -1),
                    "labels: row 2 is 1, but there are 1 exemplars");
  EXPECT_THROW_TEXT(clustering(points, column({0, 0, 0}), column({3}), nullptr, -1),
                    "exemplars: row 0 is 3, expected a point from 0 to 2");
  EXPECT_THROW_TEXT(clustering(points, column({0, 0.5, 0}), column({1}), nullptr, -1),
                    "labels: row 1 is 0.5, expected a whole number");
}

RigidMotion turned(double angle_rad, double x_mm) {
  RigidMotion motion;
  motion.rotation = {std::cos(angle_rad),  0, std::sin(angle_rad), 0, 1, 0,
                     -std::sin(angle_rad), 0, std::cos(angle_rad)};
  motion.translation_mm = {x_mm, 0, 0};
  return motion;
}

TEST(Pose, MeasuresAngleAndDistance) {
  const double degree = std::acos(-1.0) / 180;
  const PoseResult result = pose(engine::Seq<RigidMotion>({turned(31 * degree, 4), turned(1e-7 * degree, 0)}),
                                 engine::Seq<RigidMotion>({turned(30 * degree, 1), turned(0, 0)}));
  EXPECT_NEAR(result.frames.rows[0].values[0], 1, 1e-9);
  EXPECT_NEAR(result.frames.rows[0].values[1], 3, 1e-9);
  EXPECT_NEAR(result.frames.rows[1].values[0], 1e-7, 1e-12);  // small angles are not lost
  EXPECT_NEAR(cell(result.table, "rotation_max_deg"), 1, 1e-9);
  EXPECT_NEAR(cell(result.table, "translation_mean_mm"), 1.5, 1e-9);
  EXPECT_NEAR(pose(engine::Seq<RigidMotion>({turned(180 * degree, 0)}), engine::Seq<RigidMotion>({RigidMotion{}}))
                  .frames.rows[0]
                  .values[0],
              180, 1e-6);
  EXPECT_THROW_TEXT(pose({}, {}), "motion has no frames to judge");
}

}  // namespace
}  // namespace face::evaluate
