// SPDX-License-Identifier: Apache-2.0
// The differences that value types name: row "all" sums up, its first column tells how far apart two values are.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nodes/evaluate/image_difference.h"
#include "nodes/evaluate/landmarks_difference.h"
#include "nodes/evaluate/map_differences.h"
#include "nodes/evaluate/mesh_difference.h"
#include "nodes/evaluate/number_differences.h"
#include "nodes/evaluate/rig_difference.h"
#include "tests/nodes/evaluate/small_face.h"
#include "tests/nodes/evaluate/table_of.h"
#include "tests/support/expect_throw_text.h"

namespace face::evaluate {
namespace {

using test::cell;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();

TEST(MeshDifference, IsTheDistanceOfEveryVertex) {
  const Mesh a = test::small_face().neutral;
  Mesh b = a;
  b.points_mm[0][2] += 3;
  b.points_mm[1][1] -= 4;
  const MeshDifferenceResult result = mesh_difference(a, b);
  EXPECT_NEAR(cell(result.table, "mean_mm"), 7.0 / 35, 1e-6);
  EXPECT_NEAR(cell(result.table, "rms_mm"), std::sqrt(25.0 / 35), 1e-6);
  EXPECT_NEAR(cell(result.table, "largest_mm"), 4, 1e-6);
  EXPECT_NEAR(cell(result.table, "moved_percent"), 200.0 / 35, 1e-9);
  EXPECT_EQ(cell(result.table, "matched"), 1);
  EXPECT_EQ(result.picture.height, 480);
  EXPECT_GT(result.picture.width, 4 * 480);
}

TEST(MeshDifference, OfEqualMeshesIsNothing) {
  const Mesh a = test::small_face().neutral;
  EXPECT_EQ(cell(mesh_difference(a, a).table, "largest_mm"), 0);
}

TEST(MeshDifference, GoesByTheNearestVertexWhereMeshesAreNotMatched) {
  const Mesh a = test::small_face().neutral;
  Mesh b;
  b.points_mm = a.points_mm;
  b.points_mm.push_back({500, 500, 500});
  EXPECT_EQ(cell(mesh_difference(a, b).table, "largest_mm"), 0);
  EXPECT_EQ(cell(mesh_difference(a, b).table, "matched"), 0);
  Mesh one;
  one.points_mm = {{-20, -20, 2}};
  EXPECT_NEAR(cell(mesh_difference(a, one).table, "largest_mm"), std::sqrt(40.0 * 40 + 60 * 60 + 4), 1e-4);
}

TEST(MeshDifference, SaysOfNothingThatNothingWasMeasured) {
  EXPECT_TRUE(std::isnan(cell(mesh_difference({}, {}).table, "mean_mm")));
  EXPECT_EQ(mesh_difference({}, {}).picture.width, 0);
  EXPECT_TRUE(std::isnan(cell(mesh_difference(test::small_face().neutral, {}).table, "mean_mm")));
}

TEST(PointsDifference, IsInfiniteWhereAVertexIsNotFinite) {
  EXPECT_EQ(cell(points_difference({{{0, 0, 0}, {1, 1, 1}}}, {{{0, 0, 0}, {1, 3, 1}}}), "largest_mm"), 2);
  EXPECT_TRUE(std::isinf(cell(points_difference({{{0, 0, nan_f}}}, {{{0, 0, 0}}}), "mean_mm")));
}

TEST(RigDifference, NamesTheShapesThatDiffer) {
  const Rig a = test::small_face();
  Rig b = a;
  for (Vec3f& offset : b.shapes[arkit_index("jawOpen")].offsets_mm) offset[1] = -12;
  b.shapes.push_back({"own", {3}, {{0, 0, 1}}});
  const RigDifferenceResult result = rig_difference(a, b);
  ASSERT_EQ(result.table.rows.size(), 4u);  // all, neutral, jawOpen, own
  EXPECT_EQ(cell(result.table, "neutral", "largest_mm"), 0);
  EXPECT_NEAR(cell(result.table, "jawOpen", "largest_mm"), 2, 1e-5);
  EXPECT_NEAR(cell(result.table, "jawOpen", "mean_mm"), 2 * 10.0 / 35, 1e-5);
  EXPECT_NEAR(cell(result.table, "own", "largest_mm"), 1, 1e-6);
  EXPECT_NEAR(cell(result.table, "all", "largest_mm"), 2, 1e-5);
  EXPECT_GT(result.picture.width, 0);
}

TEST(RigDifference, ComparesHeadsOfOtherMeshesByTheirSurface) {
  const Rig a = test::small_face();
  Rig b = a;
  b.neutral.points_mm.push_back({0, 0, 900});
  const RigDifferenceResult result = rig_difference(a, b);
  EXPECT_EQ(result.table.rows.size(), 2u);
  EXPECT_EQ(cell(result.table, "all", "matched"), 0);
}

TEST(DepthScanDifference, MeasuresDepthsWhereBothHaveSome) {
  DepthScan a;
  a.picture = {4, 1, 1, {10, 20, 30, 40}};
  a.depth_mm = {500, 600, 700, 0};
  DepthScan b = a;
  b.depth_mm = {500, 603, 0, 800};
  b.picture.pixels[2] = 70;
  MapDifferenceResult result = depth_scan_difference(a, b);
  EXPECT_EQ(cell(result.table, "mean_mm"), 1.5);
  EXPECT_EQ(cell(result.table, "largest_mm"), 3);
  EXPECT_EQ(cell(result.table, "only_in_a"), 1);
  EXPECT_EQ(cell(result.table, "only_in_b"), 1);
  EXPECT_NEAR(cell(result.table, "picture_rms_levels"), 20, 1e-9);  // 40 in one of four
  EXPECT_EQ(cell(result.table, "same_camera"), 1);
  ASSERT_EQ(result.picture.width, 3 * 4 + 2 * 8);
  EXPECT_EQ(result.picture.pixels[3 * 24], 0);
  EXPECT_EQ(result.picture.pixels[3 * 25], 255);
  b.camera.focal_px += 1;
  EXPECT_EQ(cell(depth_scan_difference(a, b).table, "same_camera"), 0);
  b.picture = {2, 1, 1, {1, 2}};
  b.depth_mm = {500, 600};
  result = depth_scan_difference(a, b);
  EXPECT_TRUE(std::isnan(cell(result.table, "mean_mm")));
  EXPECT_EQ(result.picture.width, 4 + 8 + 2);
  b.depth_mm.pop_back();
  EXPECT_THROW_TEXT(depth_scan_difference(a, b), "depth_mm has 1 values, its picture is 2 x 1 pixels");
}

TEST(CylinderScanDifference, MeasuresRadiiAndTellsAnotherGrid) {
  CylinderScan a;
  a.picture = {2, 1, 3, {10, 20, 30, 40, 50, 60}};
  a.radius_mm = {80, 90};
  CylinderScan b = a;
  b.radius_mm[1] = 92;
  b.top_mm += 1;
  const MapDifferenceResult result = cylinder_scan_difference(a, b);
  EXPECT_EQ(cell(result.table, "mean_mm"), 1);
  EXPECT_EQ(cell(result.table, "picture_rms_levels"), 0);
  EXPECT_EQ(cell(result.table, "same_grid"), 0);
  EXPECT_EQ(cell(cylinder_scan_difference(a, a).table, "same_grid"), 1);
  EXPECT_EQ(cell(cylinder_scan_difference(a, a).table, "mean_mm"), 0);
}

TEST(AlbedoDifference, MeasuresTheChannelThatIsFarthestApart) {
  const AlbedoMap a{2, 1, {{0.5f, 0.25f, 0.25f}, {0.5f, 0.5f, 0.5f}}, {1, 0}};
  AlbedoMap b = a;
  b.albedo[0] = {0.5f, 0.5f, 0.125f};
  b.weight = {0, 1};
  const MapDifferenceResult result = albedo_difference(a, b);
  EXPECT_EQ(cell(result.table, "mean"), 0.125);
  EXPECT_EQ(cell(result.table, "largest"), 0.25);
  EXPECT_EQ(cell(result.table, "only_in_a"), 1);
  EXPECT_EQ(cell(result.table, "only_in_b"), 1);
  EXPECT_EQ(result.picture.pixels[0], 188);  // sRGB of 0.5
  b.albedo.pop_back();
  EXPECT_THROW_TEXT(albedo_difference(a, b), "b has 1 colours and 2 weights, expected 2 x 1");
}

TEST(ImageDifference, MeasuresLevelsAndShowsWhere) {
  const Image a{2, 1, 1, {10, 20}}, b{2, 1, 1, {10, 60}};
  const ImageDifferenceResult result = image_difference(a, b);
  EXPECT_NEAR(cell(result.table, "rms_levels"), std::sqrt(40.0 * 40 / 2), 1e-9);
  EXPECT_EQ(cell(result.table, "largest_levels"), 40);
  EXPECT_EQ(cell(result.table, "differing_percent"), 50);
  EXPECT_NEAR(cell(result.table, "psnr_db"), 20 * std::log10(255 / std::sqrt(800.0)), 1e-9);
  ASSERT_EQ(result.picture.width, 3 * 2 + 2 * 8);
  EXPECT_EQ(result.picture.pixels[3 * 20], 0);    // the equal pixel
  EXPECT_EQ(result.picture.pixels[3 * 21], 255);  // the other
  EXPECT_TRUE(std::isinf(cell(image_difference(a, a).table, "psnr_db")));
}

TEST(ImageDifference, PutsPicturesOfUnequalSizeBesideEachOther) {
  const ImageDifferenceResult result = image_difference({2, 1, 1, {1, 2}}, {1, 2, 1, {1, 2}});
  EXPECT_TRUE(std::isnan(cell(result.table, "rms_levels")));
  EXPECT_EQ(result.picture.width, 2 + 8 + 1);
  EXPECT_EQ(result.picture.height, 2);
}

TEST(WeightsDifference, NamesTheWeightsThatDiffer) {
  Weights longer = test::jaw(0.5);
  longer.values.push_back(0.25f);
  const Table table = weights_difference(test::jaw(0.75), longer);
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(cell(table, "largest"), 0.25);
  EXPECT_EQ(cell(table, "jawOpen", "a"), 0.75);
  EXPECT_EQ(cell(table, "shape 52", "b"), 0.25);
  EXPECT_EQ(cell(weights_difference({}, {}), "largest"), 0);
}

TEST(TableDifference, MatchesRowsAndColumnsByName) {
  const Table a{{"x_mm", "y_mm", "old"}, {{"lips", {1, 2, 3}}, {"chin", {4, nothing, 6}}, {"gone", {0, 0, 0}}}};
  const Table b{{"y_mm", "x_mm"}, {{"chin", {nothing, 4}}, {"lips", {2.5, 1}}, {"new", {0, 0}}}};
  const Table table = table_difference(a, b);
  EXPECT_EQ(cell(table, "largest"), 0.5);
  EXPECT_EQ(cell(table, "only_in_a"), 2);
  EXPECT_EQ(cell(table, "only_in_b"), 1);
  EXPECT_EQ(cell(table, "y_mm"), 0.5);
  EXPECT_EQ(cell(table, "lips", "y_mm"), 0.5);
  EXPECT_EQ(table.rows.size(), 2u);  // chin is the same: NaN in both
}

TEST(TableDifference, MatchesRowsOfOneNameInTheirOrder) {
  const Table a{{"x"}, {{"p", {1}}, {"p", {2}}}}, b{{"x"}, {{"p", {1}}, {"p", {5}}}};
  EXPECT_EQ(cell(table_difference(a, b), "largest"), 3);
  EXPECT_EQ(cell(table_difference(a, a), "largest"), 0);
}

TEST(MatrixDifference, SaysWhereTheLargestIs) {
  const Matrix a{2, 2, {1, 2, 3, 4}}, b{2, 2, {1, 2, 6, 4}};
  EXPECT_EQ(cell(matrix_difference(a, b), "largest"), 3);
  EXPECT_EQ(cell(matrix_difference(a, b), "rms"), 1.5);
  EXPECT_EQ(cell(matrix_difference(a, b), "row"), 1);
  EXPECT_EQ(cell(matrix_difference(a, b), "column"), 0);
  EXPECT_TRUE(std::isnan(cell(matrix_difference(a, {1, 4, {1, 2, 3, 4}}), "largest")));
}

TEST(AudioDifference, ComparesWhatBothLast) {
  const Audio a{10, {0.5f, 0.5f}}, b{10, {0.5f, 0.25f, 1}};
  EXPECT_NEAR(cell(audio_difference(a, b), "rms"), 0.25 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(cell(audio_difference(a, b), "longer_s"), 0.1, 1e-12);
  EXPECT_TRUE(std::isnan(cell(audio_difference(a, {20, {0.5f}}), "rms")));
}

TEST(FlowDifference, IsTheDistanceOfTheEndsThatBothKnow) {
  const FlowField a{3, 1, {{0, 0}, {1, 0}, {0, 0}}, {1, 1, 1}}, b{3, 1, {{3, 4}, {1, 0}, {0, 0}}, {1, 1, 0}};
  EXPECT_EQ(cell(flow_difference(a, b), "mean_px"), 2.5);
  EXPECT_EQ(cell(flow_difference(a, b), "only_in_a"), 1);
  EXPECT_TRUE(std::isnan(cell(flow_difference(a, {1, 1, {{0, 0}}, {1}}), "mean_px")));
}

TEST(LandmarksDifference, CountsPointsThatAreLost) {
  const Landmarks a{{{"l", 0, 0, true}, {"r", 10, 0, true}, {"m", 5, 5, false}, {"only", 1, 1, true}}};
  const Landmarks b{{{"l", 3, 4, true}, {"r", 10, 0, true}, {"m", 5, 5, true}}};
  const LandmarksDifferenceResult result = landmarks_difference(a, b);
  EXPECT_NEAR(cell(result.table, "rms_px"), 5 / std::sqrt(2.0), 1e-9);
  EXPECT_EQ(cell(result.table, "lost_in_a"), 1);
  EXPECT_EQ(cell(result.table, "lost_in_b"), 1);
  EXPECT_EQ(cell(result.table, "l", "rms_px"), 5);
  EXPECT_EQ(result.table.rows.size(), 2u);
  EXPECT_GT(result.picture.width, 0);
}

}  // namespace
}  // namespace face::evaluate
