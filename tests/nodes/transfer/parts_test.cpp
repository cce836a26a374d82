// SPDX-License-Identifier: Apache-2.0
// The parts of articulation transfer, each on a small mesh with a known answer.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "nodes/base/pose.h"
#include "nodes/base/scan_points.h"
#include "nodes/model/sample_scan.h"
#include "nodes/transfer/cylinder_lookup.h"
#include "nodes/transfer/draw_texture.h"
#include "nodes/transfer/fit_identity.h"
#include "nodes/transfer/judge_lips.h"
#include "nodes/transfer/line_mouth.h"
#include "nodes/transfer/lip_sides.h"
#include "nodes/transfer/look_up.h"
#include "nodes/transfer/mark_lips.h"
#include "nodes/transfer/morph.h"
#include "nodes/transfer/move_model.h"
#include "nodes/transfer/project_cylinder.h"
#include "nodes/transfer/recolour.h"
#include "nodes/transfer/resample.h"
#include "nodes/transfer/rest_shape.h"
#include "tests/support/expect_throw_text.h"
#include "tests/support/lip_sheet.h"

namespace {

using namespace face;
using namespace face::transfer;

constexpr int columns = test::sheet_columns, rows = test::sheet_rows;

Mesh sheet(double gap_mm, double radius_mm = 90) { return test::lip_sheet(gap_mm, radius_mm); }

std::uint32_t node(int row, int column) { return test::sheet_vertex(row, column); }

MorphableModel model_of(const Mesh& mesh) {
  MorphableModel model;
  model.mean = mesh;
  for (int c = 14; c <= 26; ++c) model.inner_lips.push_back({node(20, c), node(21, c)});
  return model;
}

Rig rig_of(const Mesh& mesh) {
  Rig rig;
  rig.neutral = mesh;
  return rig;
}

ShapeModel small_model(std::size_t vertices) {
  ShapeModel model{vertices, {}, {1}, {}, {}};
  for (std::size_t i = 0; i < 3 * vertices; ++i) {
    model.mean_mm.push_back(static_cast<double>(i));
    model.modes.push_back(1);
    model.projections.push_back(1.0 / (3.0 * static_cast<double>(vertices)));
  }
  return model;
}

template <class T>
engine::SeqWriter<T> into(std::vector<T>& list) {
  return engine::SeqWriter<T>([&list](std::string, T value) { list.push_back(std::move(value)); });
}

CylinderScan plain_cylinder(float radius_mm, std::uint8_t level) {
  CylinderScan scan;
  scan.picture = {512, 200, 3, std::vector<std::uint8_t>(512 * 200 * 3, level)};
  scan.radius_mm.assign(512 * 200, radius_mm);
  scan.top_mm = 60;
  return scan;
}

// A flat white eye of 16 rows (from 24) between dark lids, whose outermost rows have a level of their own.
DepthScan open_eye(std::uint8_t edge_level) {
  DepthScan scan;
  scan.camera.focal_px = 200;
  scan.camera.position_mm = {0, 0, 200};
  scan.camera.centre_x_px = scan.camera.centre_y_px = 31.5f;
  scan.depth_mm.assign(64 * 64, 200);
  scan.picture = {64, 64, 1, {}};
  for (int y = 0; y < 64; ++y) {
    const bool eye = y >= 24 && y < 40, edge = y == 23 || y == 40;
    scan.picture.pixels.insert(scan.picture.pixels.end(), 64, eye ? 220 : edge ? edge_level : 90);
  }
  return scan;
}

}  // namespace

TEST(LipSides, AreToldByTheOpeningAndTheWayAroundIt) {
  const Mesh mesh = sheet(4);
  const MouthOpening mouth = find_mouth_opening(mesh);
  ASSERT_TRUE(mouth.found());
  EXPECT_EQ(mouth.right_corner % columns, 11u);
  EXPECT_EQ(mouth.left_corner % columns, 29u);
  for (const std::uint32_t v : mouth.upper) EXPECT_LE(v / columns, 20u);
  for (const std::uint32_t v : mouth.lower) EXPECT_GE(v / columns, 21u);
  const std::vector<LipSide> sides = sides_of(mesh, mesh.points_mm, mouth.upper, mouth.lower, 20, 5);
  EXPECT_EQ(sides[node(20, 20)], LipSide::upper);
  EXPECT_EQ(sides[node(21, 20)], LipSide::lower);
  EXPECT_EQ(sides[node(15, 20)], LipSide::upper);
  EXPECT_EQ(sides[node(20, 4)], LipSide::none);  // cheek beside the corner
  EXPECT_EQ(sides[node(0, 20)], LipSide::none);  // too far
}

TEST(LipSides, FindNoMouthInAClosedSheet) {
  const Mesh mesh = test::lip_sheet(4, 90, false);
  EXPECT_FALSE(find_mouth_opening(mesh).found());
  class : public engine::Progress {
   public:
    void warn(const std::string& text) override { heard = text; }
    std::string heard;
  } progress;
  const MarkLipsResult result = mark_lips(rig_of(mesh), mesh, {}, progress);
  EXPECT_FALSE(result.found);
  EXPECT_TRUE(result.marked.inner_lips.empty());
  EXPECT_EQ(
      progress.heard,
      "the reference's mesh of 1681 points has no opening of a mouth: take a reference whose lips are farther apart "
      "(openness), and see in the review that its mouth was cleared");
}

TEST(ProjectCylinder, UnrollsACylinderToOneRadius) {
  const Mesh mesh = sheet(0);
  const ProjectCylinderResult result = project_cylinder(mesh, {mesh.points_mm}, {});
  std::size_t measured = 0;
  for (const float r : result.scan.radius_mm)
    if (r > 0) {
      ++measured;
      EXPECT_NEAR(r, 90, 0.05);  // flat squares of 2 mm lie a little inside
    }
  EXPECT_GT(measured, 3000u);
  const auto surface = surface_at(result.scan, 10, 0.1);
  ASSERT_TRUE(surface);
  EXPECT_NEAR(surface->normal[0], std::sin(0.1), 0.02);
  EXPECT_NEAR(surface->normal[2], std::cos(0.1), 0.02);
  EXPECT_NEAR(surface->point_mm[0], 90 * std::sin(0.1), 0.1);
  EXPECT_NEAR(surface->color_srgb[1], 0.5, 0.01);
  EXPECT_FALSE(surface_at(result.scan, 10, 2));
  EXPECT_THROW_TEXT(project_cylinder(mesh, {}, {}), "shape has 0 points, the mesh 1681");
}

TEST(FitIdentity, FindsMotionAndCoefficientOfASmallModel) {
  // A bumpy cylinder whose one mode makes the bump higher.
  Mesh mesh = sheet(0);
  MorphableModel model = model_of(mesh);
  model.identity.names = {"bump"};
  model.identity.sigmas = {1};
  for (std::size_t v = 0; v < mesh.points_mm.size(); ++v) {
    const Vec3f p = mesh.points_mm[v];
    const float bump = std::exp(-(std::pow(p[0] - 8, 2.0f) + std::pow(p[1] - 20, 2.0f)) / 120);
    const float other = std::exp(-(std::pow(p[0] + 15, 2.0f) + std::pow(p[1] + 10, 2.0f)) / 200);
    model.mean.points_mm[v] = {p[0], p[1], p[2] + 8 * bump + 6 * other};
    model.identity.modes.push_back({0, 0, 5 * bump});
  }
  std::vector<Vec3f> points = model.mean.points_mm;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vec3f p = {points[v][0], points[v][1], points[v][2] + 0.7f * model.identity.modes[v][2]};
    const float c = std::cos(0.05f), s = std::sin(0.05f);
    points[v] = {c * p[0] + s * p[2] + 1, p[1] - 2, -s * p[0] + c * p[2] + 3};
  }
  const ProjectCylinderResult cylinder = project_cylinder(mesh, {points}, {}, {.columns = 1440, .step_mm = 0.4});
  const Landmarks marks{[&] {
    std::vector<Landmark> list;
    for (const std::uint32_t v : {node(5, 5), node(5, 35), node(35, 20)}) {
      const CylinderPlace place = cylinder_place({}, points[v]);
      list.push_back({"vertex_" + std::to_string(v),
                      place.phi_rad / static_cast<double>(cylinder.scan.phi_step_rad) + 719.5,
                      (static_cast<double>(cylinder.scan.top_mm) - place.h_mm) / 0.4, true});
    }
    return list;
  }()};
  const FitIdentityResult fit = fit_identity(model, cylinder.scan, &marks);
  ASSERT_TRUE(fit.solved);
  EXPECT_NEAR(fit.coefficients.values[0], 0.7, 0.03);
  EXPECT_NEAR(fit.scan_from_model.translation_mm[1], -2, 0.1);
  EXPECT_NEAR(fit.scan_from_model.rotation[2], std::sin(0.05), 0.005);
  for (std::size_t v = 0; v < points.size(); v += 7)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(fit.points.points_mm[v][k], points[v][k], 0.35) << v;
}

TEST(FitIdentity, ReportsAScanWithoutAFaceAsUnsolved) {
  CylinderScan empty;
  empty.picture = {100, 50, 3, std::vector<std::uint8_t>(15000, 0)};
  empty.radius_mm.assign(5000, 0);
  EXPECT_FALSE(fit_identity(model_of(sheet(0)), empty, nullptr).solved);
  empty.radius_mm.pop_back();
  EXPECT_THROW_TEXT(fit_identity(model_of(sheet(0)), empty, nullptr),
                    "scan has 4999 radii, its picture is 100 x 50 pixels");
}

TEST(LookUp, KeepsTouchingLipsApart) {
  // The speaking mesh is the model itself, its lips shut and pushed 0.7 mm past each other by noise.
  const Mesh open = sheet(4);
  Mesh shut = sheet(0);
  const MorphableModel model = model_of(shut);
  MeshPoints shape{shut.points_mm};
  for (int c = 12; c < 29; ++c) {
    shape.points_mm[node(20, c)][1] -= 2.7f;
    shape.points_mm[node(21, c)][1] += 0.7f;
  }
  const SurfaceMap places = look_up(model, {shut.points_mm}, open, shape, {});
  const SurfaceMap truth = look_up(model, {shut.points_mm}, shut, {shut.points_mm}, {});
  for (int c = 14; c <= 26; ++c)
    for (const int r : {20, 21}) {
      const std::int32_t t = places.triangle[node(r, c)];
      ASSERT_GE(t, 0);
      const std::uint32_t corner = shut.corners[static_cast<std::size_t>(t / 2) * 4];
      EXPECT_EQ(corner / columns <= 20, r == 20) << "row " << r << " column " << c;
    }
  const Table table = judge_lips(places, truth, rig_of(shut));
  EXPECT_EQ(table.columns, (std::vector<std::string>{"vertices", "wrong", "lost"}));
  EXPECT_THROW_TEXT(look_up(model, {}, open, shape, {}), "fitted has 0 points, the model 1681");
  shape.points_mm[3] = {NAN, 2, 3};
  EXPECT_THROW_TEXT(look_up(model, {shut.points_mm}, open, shape, {}),
                    "shape has a point 3 at (nan, 2, 3) mm, expected one less than 10000 mm from the axis's origin");
}

TEST(JudgeLips, CountsVerticesThatWereFoundOnTheOtherLip) {
  const Mesh mesh = sheet(0);
  Rig rig = rig_of(mesh);
  rig.inner_lips = model_of(mesh).inner_lips;
  // Fan triangles are two per square; the square above and the one below the opening at column 20.
  const auto square = [&](int row, int column) {
    for (std::size_t f = 0; f < mesh.polygon_count(); ++f)
      if (mesh.corners[mesh.polygon_starts[f]] == node(row, column)) return static_cast<std::int32_t>(2 * f);
    return -1;
  };
  const SurfaceMap truth{
      3, 1, {square(18, 20), square(22, 20), square(18, 22)}, std::vector<Vec2f>(3, Vec2f{0.3f, 0.3f})};
  SurfaceMap found = truth;
  found.triangle[0] = square(22, 20);
  found.triangle[2] = -1;
  EXPECT_EQ(judge_lips(found, truth, rig).rows[0].values, (std::vector<double>{3, 1, 1}));
  EXPECT_EQ(judge_lips(truth, truth, rig).rows[0].values, (std::vector<double>{3, 0, 0}));
}

TEST(Resample, TakesPointsAndColoursAndFillsInBetween) {
  const Mesh mesh = sheet(0);
  Rig head = rig_of(mesh);
  for (Vec3f& p : head.neutral.points_mm) p[2] += 5;
  for (Vec3f& c : head.neutral.colors_srgb) c = {0.8f, 0.4f, 0.2f};
  SurfaceMap places = look_up(model_of(mesh), {mesh.points_mm}, mesh, {mesh.points_mm}, {});
  for (const int c : {7, 8, 9}) places.triangle[node(8, c)] = -1;
  RigidMotion up;
  up.translation_mm = {0, 2, 0};
  const MeshPoints points = resample(places, head, nullptr, &up, mesh, {mesh.points_mm});
  for (std::size_t v = 0; v < points.points_mm.size(); ++v) {
    EXPECT_NEAR(points.points_mm[v][1], mesh.points_mm[v][1] + 2, 1e-3) << v;
    EXPECT_NEAR(points.points_mm[v][2], mesh.points_mm[v][2] + 5, 1e-3) << v;
  }
  const Mesh coloured = resample_colours(places, head, mesh);
  EXPECT_NEAR(coloured.colors_srgb[node(8, 8)][0], 0.8f, 1e-4);
  EXPECT_EQ(coloured.points_mm, mesh.points_mm);
  EXPECT_THROW_TEXT(resample(places, head, nullptr, nullptr, mesh, {}), "shape has 0 points, the mesh 1681");
  head.neutral.parts = {{"face", 0, 1600, {1, 1, 1}, 0, true}};
  EXPECT_THROW_TEXT(resample_colours(places, head, mesh),
                    "head has a part face that ends at polygon 1600, its mesh at 1582");
  head.neutral.colors_srgb.pop_back();
  EXPECT_THROW_TEXT(resample_colours(places, head, mesh), "head has 1680 colours for 1681 points");
}

TEST(ResampleScan, TakesTheScansOwnShape) {
  // The scan is 3 mm farther out than the model that was fitted to it.
  const Mesh mesh = sheet(0);
  const CylinderScan scan = plain_cylinder(93, 100);
  const SurfaceMap places = look_up(model_of(mesh), {mesh.points_mm}, mesh, {mesh.points_mm}, {});
  const ResampleScanResult result =
      resample_scan(places, rig_of(mesh), {mesh.points_mm}, scan, nullptr, nullptr, mesh, {mesh.points_mm});
  for (const Vec3f& p : result.shape.points_mm) EXPECT_NEAR(std::hypot(p[0], p[2]), 93, 0.01);
  EXPECT_NEAR(result.mesh.colors_srgb[5][0], 100 / 255.0, 1e-4);
}

TEST(ResampleScan, ColoursAHoleOfTheScanAsWhatIsAboutIt) {
  const Mesh mesh = sheet(0);
  CylinderScan scan = plain_cylinder(90, 60);
  const SurfaceMap places = look_up(model_of(mesh), {mesh.points_mm}, mesh, {mesh.points_mm}, {});
  const auto colours = [&] {
    return resample_scan(places, rig_of(mesh), {mesh.points_mm}, scan, nullptr, nullptr, mesh, {mesh.points_mm})
        .mesh.colors_srgb;
  };
  for (std::size_t y = 80; y < 110; ++y)
    for (std::size_t x = 240; x < 280; ++x) scan.radius_mm[y * 512 + x] = 0;
  for (const Vec3f& c : colours()) EXPECT_NEAR(c[0], 60 / 255.0, 1e-4);
  scan.radius_mm.assign(512 * 200, 0);
  EXPECT_EQ(colours()[5], (Vec3f{0.5f, 0.5f, 0.5f}));  // nothing is known
}

TEST(ScanPlaces, ReadsTheTruthAtEveryVertexPixel) {
  const Mesh mesh = sheet(0);
  SurfaceMap truth{columns, rows, {}, {}};
  for (int i = 0; i < columns * rows; ++i) {
    truth.triangle.push_back(i);
    truth.weights.push_back({0.25f, static_cast<float>(i)});
  }
  const SurfaceMap places = scan_places(truth, mesh, nullptr);
  for (std::size_t v = 0; v < places.triangle.size(); ++v) EXPECT_EQ(places.triangle[v], static_cast<int>(v));
  // The first hundred squares are teeth, two triangles each.
  Rig head = rig_of(mesh);
  head.neutral.parts = {{"teeth", 0, 100, {1, 1, 1}, 0, true},
                        {"face", 100, static_cast<std::uint32_t>(mesh.polygon_count()) - 100, {1, 1, 1}, 0, true}};
  const SurfaceMap skin = scan_places(truth, mesh, &head);
  EXPECT_EQ(skin.triangle[199], -1);
  EXPECT_EQ(skin.triangle[200], 200);
}

TEST(RestShape, IsTheMeanOfSilence) {
  std::vector<MeshPoints> shapes;
  for (int t = 0; t < 10; ++t) shapes.push_back({{{static_cast<float>(t), 0, 0}}});
  Timeline timeline;
  for (int t = 0; t < 10; ++t) timeline.time_s.push_back(0.1 * t);
  timeline.duration_s = 1;
  const Phones phones{{{"SIL", 0, 0.45, "", 0}, {"AA", 0.45, 1, "a", 0}}, 1, true};
  EXPECT_NEAR(rest_shape(engine::Seq<MeshPoints>(shapes), timeline, phones, nullptr).points_mm[0][0], 2, 1e-6);
  const engine::Seq<bool> known({true, false, true, true, true, true, true, true, true, true});
  EXPECT_NEAR(rest_shape(engine::Seq<MeshPoints>(shapes), timeline, phones, &known).points_mm[0][0], 2.5, 1e-6);
  EXPECT_THROW_TEXT(rest_shape(engine::Seq<MeshPoints>(shapes), timeline, phones, nullptr, {.label = "ZH"}),
                    "no frame lies within a segment of \"ZH\" of 2 segments");
  const engine::Seq<bool> none(std::vector<bool>(10, false));
  EXPECT_THROW_TEXT(rest_shape(engine::Seq<MeshPoints>(shapes), timeline, phones, &none),
                    "no known frame lies within a segment of \"SIL\" of 2 segments");
}

TEST(RestShape, IsTheMeanOfClosuresOrOfSilenceWhereThereAreNone) {
  std::vector<MeshPoints> shapes;
  Timeline timeline;
  for (int t = 0; t < 10; ++t) {
    shapes.push_back({{{static_cast<float>(t), 0, 0}}});
    timeline.time_s.push_back(0.1 * t);
  }
  timeline.duration_s = 1;
  const auto rest = [&](const Phones& phones) {
    return rest_shape(engine::Seq<MeshPoints>(shapes), timeline, phones, nullptr,
                      {.label = "P B M, SIL", .margin_s = 0.03})
        .points_mm[0][0];
  };
  const Phones speech{
      {{"SIL", 0, 0.25, "", 0}, {"P.c", 0.25, 0.45, "p", 0}, {"P.r", 0.45, 0.65, "p", 0}, {"M", 0.65, 1, "m", 0}},
      1,
      true};
  EXPECT_NEAR(rest(speech), (3 + 4 + 7 + 8 + 9) / 5.0, 1e-6);
  EXPECT_NEAR(rest({{{"SIL", 0, 0.25, "", 0}, {"P.r", 0.25, 0.6, "p", 0}, {"AA", 0.6, 1, "a", 0}}, 1, true}), 1.5,
              1e-6);
}

TEST(MoveModel, KeepsDisplacementsAndChangesTheFace) {
  const ShapeModel model = small_model(2);
  const ShapeModel moved = move_model(model, {{{0, 0, 0}, {1, 1, 1}}}, {{{0, 0, 2}, {1, 1, 1}}});
  EXPECT_EQ(moved.mean_mm, (std::vector<double>{0, 1, 4, 3, 4, 5}));
  EXPECT_EQ(moved.modes, model.modes);
  EXPECT_THROW_TEXT(move_model(model, {{{0, 0, 0}}}, {{{0, 0, 0}}}), "from has 1 points, to 1, the model 2");
}

TEST(RestModel, CountsCoefficientsFromTheNeutralFace) {
  ShapeModel model = small_model(2);
  const MeshPoints rest{{{3, 4, 5}, {6, 7, 8}}};  // the mean and three of the mode
  const ShapeModel rested = rest_model(model, rest);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(rested.mean_mm[i], static_cast<double>(i) + 3, 1e-9);
}

TEST(FreezeEdges, FadesModesToTheOutlineAndNotToTheLips) {
  const Mesh mesh = sheet(4);
  const ShapeModel frozen = freeze_edges(small_model(mesh.points_mm.size()), mesh, {.width_mm = 10});
  const auto mode = [&](std::uint32_t v) { return frozen.modes[3 * v]; };
  EXPECT_EQ(mode(node(0, 7)), 0);
  EXPECT_NEAR(mode(node(2, 20)), 0.352, 0.05);  // 4 of 10 mm
  EXPECT_EQ(mode(node(20, 20)), 1);
  EXPECT_EQ(mode(node(21, 18)), 1);
}

TEST(Recolour, ReplacesTheTextureOrKeepsItsLight) {
  Mesh mesh = sheet(0), colours = mesh;
  for (Vec3f& c : colours.colors_srgb) c = {0.6f, 0.3f, 0.3f};
  EXPECT_EQ(recolour(mesh, colours).colors_srgb[3], colours.colors_srgb[3]);
  const Vec3f kept = recolour(mesh, colours, {.recorded = 1}).colors_srgb[3];
  EXPECT_NEAR(0.299f * kept[0] + 0.587f * kept[1] + 0.114f * kept[2], 0.5, 1e-4);
  EXPECT_NEAR(kept[0] / kept[1], 2, 1e-4);
  colours.colors_srgb[node(10, 10)] = {1, 1, 1};
  EXPECT_LT(recolour(mesh, colours, {.smooth_mm = 4}).colors_srgb[node(10, 10)][1], 0.45f);
  colours.colors_srgb.clear();
  EXPECT_THROW_TEXT(recolour(mesh, colours), "mesh has 1681 colours and colours 0, expected 1681, one per vertex");
}

TEST(Morph, GoesFromOneSpeakingFaceToTheOther) {
  Rig from, to;
  from.neutral.points_mm = {{0, 0, 0}};
  to.neutral.points_mm = {{10, 0, 0}};
  from.neutral.colors_srgb = {{0, 0, 0}};
  to.neutral.colors_srgb = {{1, 1, 1}};
  from.shapes = to.shapes = {{"open", {0}, {{0, 1, 0}}}};
  std::vector<Rig> heads;
  std::vector<Weights> poses;
  auto heads_writer = into(heads);
  auto poses_writer = into(poses);
  morph(from, to, engine::Seq<Weights>(std::vector<Weights>(5, Weights{{2}})), heads_writer, poses_writer);
  ASSERT_EQ(heads.size(), 5u);
  const auto x = [&](std::size_t t) { return pose_points(heads[t], poses[t])[0][0]; };
  EXPECT_EQ(x(0), 0);
  EXPECT_NEAR(x(2), 5, 1e-5);
  EXPECT_EQ(x(4), 10);
  EXPECT_EQ(pose_points(heads[2], poses[2])[0][1], 2);
  EXPECT_NEAR(heads[2].neutral.colors_srgb[0][0], 0.5, 1e-6);
  EXPECT_EQ(heads[4].neutral.points_mm[0], from.neutral.points_mm[0]);  // what a camera is set by stays
}

TEST(MarkLips, PairsTheEdgesAndMarksTheLips) {
  const Mesh mesh = sheet(4);
  engine::Progress quiet;
  const MarkLipsResult result = mark_lips(rig_of(mesh), mesh, {}, quiet);
  EXPECT_GE(result.marked.inner_lips.size(), 8u);
  for (const LipPair& pair : result.marked.inner_lips) {
    EXPECT_EQ(pair.upper / columns, 20u);
    EXPECT_EQ(pair.lower, pair.upper + columns);
  }
  EXPECT_EQ(result.lips.on[node(20, 20)], 1);
  EXPECT_EQ(result.lips.on[node(2, 20)], 0);
}

TEST(LineMouth, SpansTheOpeningFromLipToLip) {
  const Mesh open = sheet(4);
  const Rig lined = line_mouth(rig_of(open), open, {.rim_mm = 0});
  EXPECT_EQ(lined.neutral.points_mm, open.points_mm);
  ASSERT_EQ(lined.neutral.parts.size(), open.parts.size() + 1);
  const Part& mouth = lined.neutral.parts.back();
  EXPECT_EQ(mouth.name, "mouth");
  EXPECT_EQ(mouth.first_polygon, open.polygon_count());
  // It faces the viewer everywhere, is as large as the opening, and leaves none.
  double area_mm2 = 0;
  for (std::uint32_t f = mouth.first_polygon; f < lined.neutral.polygon_count(); ++f) {
    const std::uint32_t* c = lined.neutral.corners.data() + lined.neutral.polygon_starts[f];
    const auto at = [&](int k) { return open.points_mm[c[k]]; };
    const float twice = (at(1)[0] - at(0)[0]) * (at(2)[1] - at(0)[1]) - (at(2)[0] - at(0)[0]) * (at(1)[1] - at(0)[1]);
    EXPECT_GE(twice, 0) << "polygon " << f;
    area_mm2 += 0.5 * static_cast<double>(twice);
  }
  EXPECT_GT(area_mm2, 40);
  EXPECT_FALSE(find_mouth_opening(lined.neutral).found());
  EXPECT_EQ(line_mouth(rig_of(sheet(0)), test::lip_sheet(0, 90, false)).neutral.parts.size(), sheet(0).parts.size());
  EXPECT_THROW_TEXT(line_mouth({}, open), "rig has 0 vertices, the mesh 1681");
}

// Lips that end 2 mm before they meet when the mouth is shut.
TEST(LineMouth, LetsShutLipsMeet) {
  const Mesh open = sheet(4);
  Rig rig = rig_of(sheet(0));
  rig.neutral.corners = open.corners;
  rig.neutral.polygon_starts = open.polygon_starts;
  Shape opened{"open", {}, {}};
  for (std::uint32_t v = 0; v < open.points_mm.size(); ++v) {
    opened.vertices.push_back(v);
    opened.offsets_mm.push_back({0, open.points_mm[v][1] - rig.neutral.points_mm[v][1], 0});
  }
  rig.shapes = {opened};
  const auto area_of = [](const Rig& lined, const std::string& name, double weight) {
    const auto part = std::find_if(lined.neutral.parts.begin(), lined.neutral.parts.end(),
                                   [&](const Part& p) { return p.name == name; });
    EXPECT_NE(part, lined.neutral.parts.end());
    std::vector<Vec3f> points = lined.neutral.points_mm;
    for (std::size_t i = 0; i < lined.shapes[0].vertices.size(); ++i)
      points[lined.shapes[0].vertices[i]][1] += static_cast<float>(weight) * lined.shapes[0].offsets_mm[i][1];
    double area_mm2 = 0;
    for (std::uint32_t f = part->first_polygon; f < part->first_polygon + part->polygon_count; ++f) {
      const std::uint32_t* c = lined.neutral.corners.data() + lined.neutral.polygon_starts[f];
      const auto at = [&](int k) { return points[c[k]]; };
      const float twice = (at(1)[0] - at(0)[0]) * (at(2)[1] - at(0)[1]) - (at(2)[0] - at(0)[0]) * (at(1)[1] - at(0)[1]);
      EXPECT_GE(twice, -1e-4) << "polygon " << f;
      area_mm2 += 0.5 * static_cast<double>(twice);
    }
    return area_mm2;
  };
  const Rig without = line_mouth(rig, open, {.rim_mm = 0}), lined = line_mouth(rig, open),
            short_rims = line_mouth(rig, open, {.rim_mm = 0.5});
  EXPECT_GT(area_of(without, "mouth", 0), 30);
  EXPECT_LT(area_of(lined, "mouth", 0), 2);  // the sheet's opening is 2 mm high in its corners: a triangle in each
  EXPECT_GT(area_of(short_rims, "mouth", 0), 10);
  // Opened by 4 mm more there are 4 mm between the rims, which are as they were.
  EXPECT_NEAR(area_of(lined, "mouth", 1), area_of(without, "mouth", 1) - area_of(lined, "rims", 0), 0.5);
  EXPECT_NEAR(area_of(lined, "rims", 1), area_of(lined, "rims", 0), 1);
  ASSERT_GT(lined.neutral.points_mm.size(), open.points_mm.size());
  EXPECT_EQ(lined.neutral.colors_srgb.size(), lined.neutral.points_mm.size());
  EXPECT_EQ(lined.shapes[0].vertices.size(), lined.neutral.points_mm.size());
  EXPECT_EQ(lined.neutral.colors_srgb.back(), open.colors_srgb[0]);
  // As many for every mouth of this mesh, so that one head can become another.
  EXPECT_EQ(short_rims.neutral.points_mm.size(), lined.neutral.points_mm.size());
}

// A tilted wall with a smooth picture, and the same wall seen by a scanner that stands elsewhere.
TEST(DrawTexture, OfTheRightShapeIsTheFramesOwnPicture) {
  DepthScan reference;
  reference.camera.focal_px = 200;
  reference.camera.position_mm = {0, 0, 200};
  reference.camera.centre_x_px = reference.camera.centre_y_px = 31.5f;
  const auto grey = [](double x_mm, double y_mm) {
    return 120 + 40 * std::sin(0.2 * x_mm) + 30 * std::cos(0.15 * y_mm);
  };
  const auto seen_by = [&](DepthScan scan) {
    scan.picture = {64, 64, 1, {}};
    const ScanRays rays(scan.camera);
    scan.depth_mm.assign(64 * 64, 200);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const Vec3f p = rays.point(x, y, 200);
        scan.picture.pixels.push_back(static_cast<std::uint8_t>(std::lround(grey(p[0], p[1]))));
      }
    return scan;
  };
  DepthScan frame = reference;
  frame.camera.position_mm = {5.3f, -3.1f, 200};
  reference = seen_by(reference);
  frame = seen_by(frame);
  const Mesh mesh = model::scan_mesh(reference);
  const DrawTextureResult result = draw_texture(mesh, reference, {mesh.points_mm}, frame);
  EXPECT_EQ(result.picture.pixels, frame.picture.pixels);
  std::size_t drawn = 0;
  for (std::size_t i = 0; i < result.mask.pixels.size(); ++i) {
    if (result.mask.pixels[i] == 0) continue;
    ++drawn;
    ASSERT_NEAR(result.drawn.pixels[i], frame.picture.pixels[i], 1.01) << i;  // both are rounded
  }
  EXPECT_GT(drawn, 3000u);
  // Where a pixel beside it is not drawn, a pixel is not in a mask without edges; the drawing has it.
  const DrawTextureResult inner = draw_texture(mesh, reference, {mesh.points_mm}, frame, nullptr, {.edge_px = 1});
  EXPECT_EQ(inner.drawn.pixels, result.drawn.pixels);
  for (int y = 1; y < 63; ++y)
    for (int x = 1; x < 63; ++x) {
      const auto in = [&](int px, int py) { return result.mask.pixels[static_cast<std::size_t>(64 * py + px)] > 0; };
      const bool all = in(x, y) && in(x - 1, y) && in(x + 1, y) && in(x, y - 1) && in(x, y + 1);
      ASSERT_EQ(inner.mask.pixels[static_cast<std::size_t>(64 * y + x)] > 0, all) << x << ' ' << y;
    }
  // A shape that is 2 mm beside it shows.
  MeshPoints moved{mesh.points_mm};
  for (Vec3f& p : moved.points_mm) p[0] += 2;
  const DrawTextureResult wrong = draw_texture(mesh, reference, moved, frame);
  double square = 0;
  for (std::size_t i = 0; i < wrong.mask.pixels.size(); ++i)
    if (wrong.mask.pixels[i]) square += std::pow(wrong.drawn.pixels[i] - wrong.picture.pixels[i], 2);
  EXPECT_GT(std::sqrt(square / static_cast<double>(drawn)), 5);
}

TEST(DrawTexture, ShowsNoLineOfAnEyeThatIsShut) {
  const DepthScan reference = open_eye(90);
  const Mesh mesh = model::scan_mesh(reference);
  MeshPoints shut{mesh.points_mm};
  for (Vec3f& p : shut.points_mm)  // they meet in the middle of a row of pixels
    p[1] = 0.5f + (std::fabs(p[1]) > 8 ? p[1] - std::copysign(9.3f, p[1]) : p[1] / 100);
  const auto brightest = [&](double least_area) {
    const DrawTextureResult result = draw_texture(mesh, reference, shut, reference, nullptr, {least_area});
    std::uint8_t most = 0;
    for (int y = 20; y < 44; ++y)
      for (int x = 4; x < 60; ++x) {
        EXPECT_EQ(result.mask.pixels[static_cast<std::size_t>(64 * y + x)], 255);
        most = std::max(most, result.drawn.pixels[static_cast<std::size_t>(64 * y + x)]);
      }
    return most;
  };
  EXPECT_GT(brightest(0), 200);
  EXPECT_LT(brightest(0.1), 100);
}

// In the reference the lids' edges are half white: their pixels see lid and eye.
TEST(DrawTexture, ShowsNothingOfTheEyeThatIsMixedIntoALidsEdge) {
  const DepthScan reference = open_eye(155);
  const Mesh mesh = model::scan_mesh(reference);
  MeshPoints shut{mesh.points_mm};
  for (Vec3f& p : shut.points_mm) p[1] = p[1] > 8 ? p[1] - 9.3f : p[1] < -8 ? p[1] + 8.3f : p[1] / 100;
  const DrawTextureResult result = draw_texture(mesh, reference, shut, reference);
  for (int y = 20; y < 44; ++y)
    for (int x = 4; x < 60; ++x) EXPECT_NEAR(result.drawn.pixels[static_cast<std::size_t>(64 * y + x)], 90, 4) << y;
}

TEST(DrawTexture, RejectsAShapeOfAnotherMesh) {
  DepthScan scan;
  scan.camera.focal_px = 100;
  scan.picture = {4, 4, 1, std::vector<std::uint8_t>(16, 0)};
  scan.depth_mm.assign(16, 50);
  const Mesh mesh = model::scan_mesh(scan);
  EXPECT_THROW_TEXT(draw_texture(mesh, scan, {}, scan), "shape has 0 points, the mesh 4");
  DepthScan other = scan;
  other.picture = {2, 8, 1, std::vector<std::uint8_t>(16, 7)};
  EXPECT_THROW_TEXT(draw_texture(mesh, scan, {mesh.points_mm}, scan, &other), "seen is 2 x 8 pixels, frame 4 x 4");
  other.picture = {4, 4, 1, std::vector<std::uint8_t>(16, 7)};
  EXPECT_EQ(draw_texture(mesh, scan, {mesh.points_mm}, scan, &other).picture.pixels, other.picture.pixels);
}
