// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/face_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "nodes/evaluate/rank_tables.h"
#include "tests/nodes/evaluate/small_face.h"
#include "tests/nodes/evaluate/table_of.h"
#include "tests/support/expect_throw_text.h"

namespace face::evaluate {
namespace {

using test::cell;

// The small face, which one component turns about its upright axis; a small angle is a linear change.
constexpr double small_angle = 0.01;
MorphableModel turning_model() {
  MorphableModel model;
  model.mean = test::small_face().neutral;
  model.mean_albedo.assign(model.mean.points_mm.size(), Vec3f{0.5f, 0.5f, 0.5f});
  model.identity.names = {"turn"};
  model.identity.sigmas = {1};
  for (const Vec3f& p : model.mean.points_mm)
    model.identity.modes.push_back(
        {static_cast<float>(small_angle) * p[2], 0, static_cast<float>(-small_angle) * p[0]});
  return model;
}

RigidMotion turned(double angle) {
  RigidMotion motion;
  motion.rotation = {std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle)};
  return motion;
}

Camera seen(double angle) {
  Camera camera;
  const RigidMotion motion = turned(angle);
  for (std::size_t i = 0; i < 9; ++i) camera.cam_from_world[i] = static_cast<float>(motion.rotation[i]);
  return camera;
}

constexpr double degree = std::numbers::pi / 180;

TEST(FaceFit, FindsNothingWrongWithTheTruth) {
  const RigidMotion motion = turned(20 * degree);
  FaceFit fit;
  fit.identity = {0};
  fit.camera = seen(20 * degree);
  fit.lip_gap_mm = 5;
  fit.converged = true;
  const Table table = face_fit(turning_model(), fit, test::small_face(), test::jaw(0), &motion, {}, nullptr, nullptr);
  EXPECT_NEAR(cell(table, "fit", "vertex_mm"), 0, 1e-5);
  EXPECT_NEAR(cell(table, "fit", "pose_deg"), 0, 1e-4);
  EXPECT_NEAR(cell(table, "fit", "lip_gap_mm"), 5, 1e-6);  // the person's mouth is shut
  EXPECT_NEAR(cell(table, "fit", "turn_deg"), 20, 1e-4);
  EXPECT_EQ(cell(table, "fit", "converged"), 1);
}

TEST(FaceFit, DoesNotCountATurnThatTheComponentsAndTheCameraShare) {
  FaceFit fit;
  fit.identity = {1};
  fit.camera = seen(-small_angle);
  const Table table = face_fit(turning_model(), fit, test::small_face(), test::jaw(0), nullptr, {}, nullptr, nullptr);
  EXPECT_NEAR(cell(table, "fit", "pose_deg"), 0, 0.01);
  fit.camera = seen(0);
  const Table other = face_fit(turning_model(), fit, test::small_face(), test::jaw(0), nullptr, {}, nullptr, nullptr);
  EXPECT_NEAR(cell(other, "fit", "pose_deg"), small_angle / degree, 0.01);
}

TEST(FaceFit, CountsFromTheStartWhereOneIsGiven) {
  const RigidMotion begin = turned(10 * degree), now = turned(25 * degree);
  FaceFit start, fit;
  start.identity = fit.identity = {0};
  start.camera = seen(13 * degree);
  fit.camera = seen(27 * degree);
  const Table table = face_fit(turning_model(), fit, test::small_face(), test::jaw(0), &now, {}, &start, &begin);
  EXPECT_NEAR(cell(table, "fit", "pose_deg"), 1, 1e-4);
}

TEST(FaceFit, MeasuresHowFarTheMiddleVertexIsOff) {
  Rig person = test::small_face();
  for (std::size_t v = 0; v < person.neutral.points_mm.size(); ++v) person.neutral.points_mm[v][2] += v % 2 ? 1 : -1;
  FaceFit fit;
  fit.identity = {0};
  const Table table = face_fit(turning_model(), fit, person, test::jaw(0), nullptr, {}, nullptr, nullptr);
  EXPECT_NEAR(cell(table, "fit", "vertex_mm"), 1, 0.05);  // 35 vertices: their mean is not quite 0
}

TEST(FaceFit, TellsSizeFromShape) {
  Rig person = test::small_face();
  for (Vec3f& p : person.neutral.points_mm)
    for (float& x : p) x *= 0.8f;
  FaceFit fit;
  fit.identity = {0};
  const Table table = face_fit(turning_model(), fit, person, test::jaw(0), nullptr, {}, nullptr, nullptr);
  EXPECT_GT(cell(table, "fit", "vertex_mm"), 3);
  EXPECT_NEAR(cell(table, "fit", "shape_mm"), 0, 1e-5);
  EXPECT_NEAR(cell(table, "fit", "size_percent"), 25, 1e-4);
}

TEST(FaceFit, OfPointsThatWereNoUseMeasuresNothing) {
  const Table table = face_fit(turning_model(), {}, test::small_face(), test::jaw(0), nullptr, {}, nullptr, nullptr);
  EXPECT_TRUE(std::isnan(cell(table, "fit", "vertex_mm")));
  EXPECT_TRUE(std::isnan(cell(table, "fit", "pose_deg")));
  EXPECT_EQ(cell(table, "fit", "converged"), 0);
}

TEST(FaceFit, RejectsAnotherRig) {
  EXPECT_THROW_TEXT(face_fit(turning_model(), {}, {}, {}, nullptr, {}, nullptr, nullptr),
                    "the rig has 0 vertices, the model 35");
}

TEST(RankTables, TellsTheMiddleAndTheLargest) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const Table a{{"mm"}, {{"fit", {1}}}}, b{{"mm"}, {{"fit", {5}}}}, c{{"mm"}, {{"fit", {nothing}}}},
      d{{"mm"}, {{"x", {2}}, {"y", {4}}}};
  const Table ranked = rank_tables(engine::Seq<Table>({a, b, c, d}, {"one", "two", "three", "four"}));
  EXPECT_EQ(cell(ranked, "two", "mm"), 5);
  EXPECT_EQ(cell(ranked, "four.y", "mm"), 4);
  EXPECT_EQ(cell(ranked, "median", "mm"), 3);
  EXPECT_NEAR(cell(ranked, "p90", "mm"), 4.7, 1e-9);  // between 4 and 5, as numpy
  EXPECT_EQ(cell(ranked, "largest", "mm"), 5);
}

TEST(RankTables, RejectsNoneAndOtherColumns) {
  EXPECT_THROW_TEXT(rank_tables({}), "there are no tables to rank");
  EXPECT_THROW_TEXT(rank_tables(engine::Seq<Table>({{{"a"}, {}}, {{"b"}, {}}})),
                    "table 1 has other columns than table 0");
  EXPECT_THROW_TEXT(rank_tables(engine::Seq<Table>({{{"a"}, {{"x", {}}}}})), "table 0: row x has 0 values, expected 1");
}

}  // namespace
}  // namespace face::evaluate
