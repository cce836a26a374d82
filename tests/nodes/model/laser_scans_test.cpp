// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "nodes/flow/cylinder_colours.h"
#include "nodes/flow/scan_flow.h"
#include "nodes/model/add_teeth.h"
#include "nodes/model/batch_flags.h"
#include "nodes/model/closest_combination.h"
#include "nodes/model/cylinder_grid.h"
#include "nodes/model/from_scans.h"
#include "nodes/model/head_points.h"
#include "nodes/model/head_rig.h"
#include "nodes/model/match_cylinder.h"
#include "nodes/model/mean_shape.h"
#include "nodes/model/region_pca.h"
#include "nodes/model/resample_shape.h"
#include "nodes/model/scan_surface.h"
#include "nodes/model/scanned_rig.h"
#include "tests/nodes/model/scans_material.h"
#include "tests/support/expect_throw_text.h"

namespace face::model {
namespace {

double median_distance(const MeshPoints& a, const MeshPoints& b) {
  std::vector<double> all;
  for (std::size_t v = 0; v < a.points_mm.size(); ++v)
    all.push_back(std::hypot(a.points_mm[v][0] - b.points_mm[v][0], a.points_mm[v][1] - b.points_mm[v][1],
                             a.points_mm[v][2] - b.points_mm[v][2]));
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

MeshPoints skin_of(const MorphableModel& surface) {
  return {{surface.mean.points_mm.begin(),
           surface.mean.points_mm.begin() + static_cast<std::ptrdiff_t>(skin_count(surface))}};
}

MatchCylinderResult matched(const MorphableModel& surface, const MeshPoints& start, const CylinderScan& target) {
  const CylinderScan drawn = draw_cylinder(surface, start, test::half_open().taken.scan);
  const FlowField flow =
      flow::scan_flow(flow::cylinder_colours(drawn), flow::cylinder_colours(target), nullptr, {.radius_weight = 0.2});
  return match_cylinder(surface, start, drawn, target, flow);
}

TEST(CylinderGrid, GoesFromPixelsToPointsAndBack) {
  const CylinderScan& scan = test::half_open().taken.scan;
  const CylinderPixel pixel = cylinder_pixel(scan, cylinder_world(scan, {100.25, 77.5, 84}));
  EXPECT_NEAR(pixel.x_px, 100.25, 1e-3);  // floats of a hundred mm
  EXPECT_NEAR(pixel.y_px, 77.5, 1e-3);
  EXPECT_NEAR(pixel.radius_mm, 84, 1e-3);
}

TEST(ScanTemplate, LiesOnTheScannedHead) {
  EXPECT_LT(median_distance(skin_of(test::half_open_surface()), test::truth_of(test::half_open())), 0.15);  // noise
}

TEST(ScanTemplate, HasAMouthAndPairsAcrossIt) {
  const MorphableModel& surface = test::half_open_surface();
  EXPECT_GT(mouth_loop(surface).size(), 20u);
  ASSERT_GT(surface.inner_lips.size(), 3u);
  for (const LipPair& pair : surface.inner_lips)
    EXPECT_GT(surface.mean.points_mm[pair.upper][1], surface.mean.points_mm[pair.lower][1]);
}

// Rows of the picture at which the lips end, column by column.
std::map<float, std::pair<float, float>> lip_rows(const MorphableModel& surface, const CylinderScan& scan) {
  std::map<float, std::pair<float, float>> rows;
  const auto row = [&](std::uint32_t v) {
    return (1 - surface.mean.uvs[v][1]) * static_cast<float>(scan.picture.height) - 0.5f;
  };
  for (const LipPair& pair : surface.inner_lips)
    rows[surface.mean.uvs[pair.upper][0]] = {row(pair.upper), row(pair.lower)};
  return rows;
}

TEST(ScanTemplate, EndsItsLipsWhereTheMouthBeginsHoweverCoarseItIs) {
  const CylinderScan& scan = test::half_open().taken.scan;
  const Landmarks marks = test::marks_of(test::half_open());
  const auto fine = lip_rows(scan_template(scan, marks, {.row_step_px = 1, .column_step_px = 1}), scan);
  const auto coarse = lip_rows(scan_template(scan, marks, {.row_step_px = 5, .column_step_px = 1}), scan);
  ASSERT_GT(coarse.size(), 8u);
  for (const auto& [u, rows] : coarse) {
    const auto at = fine.find(u);
    ASSERT_NE(at, fine.end());
    EXPECT_NEAR(rows.first, at->second.first, 1.5) << u;
    EXPECT_NEAR(rows.second, at->second.second, 1.5) << u;
  }
}

TEST(ScanTemplate, TakesNothingInsideTheMouthForLip) {
  const CylinderScan& scan = test::half_open().taken.scan;
  const MorphableModel& surface = test::half_open_surface();
  const std::vector<std::uint32_t> loop = mouth_loop(surface);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3f &p = surface.mean.points_mm[loop[i]], &q = surface.mean.points_mm[loop[(i + 1) % loop.size()]];
    EXPECT_LT(std::abs(cylinder_pixel(scan, p).radius_mm - cylinder_pixel(scan, q).radius_mm), 7)
        << "from row " << p[1] << " to " << q[1];
  }
}

TEST(ScanTemplate, IsClosedBelowTheChin) {
  // One edge around the skin, one around the mouth: no hole where the chin hides what is below it.
  const MorphableModel& surface = test::half_open_surface();
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (std::size_t c = 0; c < surface.mean.corners.size(); ++c) {
    const std::uint32_t a = surface.mean.corners[c], b = surface.mean.corners[c % 3 == 2 ? c - 2 : c + 1];
    ++uses[{std::min(a, b), std::max(a, b)}];
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> next;
  for (const auto& [edge, count] : uses)
    if (count == 1) {
      next[edge.first].push_back(edge.second);
      next[edge.second].push_back(edge.first);
    }
  int loops = 0;
  for (std::set<std::uint32_t> seen; const auto& [start, unused] : next) {
    if (seen.contains(start)) continue;
    ++loops;
    for (std::vector<std::uint32_t> left = {start}; !left.empty();) {
      const std::uint32_t v = left.back();
      left.pop_back();
      if (seen.insert(v).second) left.insert(left.end(), next[v].begin(), next[v].end());
    }
  }
  EXPECT_EQ(loops, 2);
}

TEST(ScanTemplate, IsWholeWhereTheMouthIsShut) {
  const test::ScannedFace rest = test::scan_face(test::face_of({}));
  const MorphableModel surface = scan_template(rest.taken.scan, test::marks_of(rest));
  EXPECT_TRUE(mouth_loop(surface).empty());
  EXPECT_TRUE(surface.inner_lips.empty());
}

TEST(ScanTemplate, LeavesTheBathingCapOut) {
  // The cap is grey and the skin is not: no vertex has the cap's colour.
  for (const Vec3f& colour : test::half_open_surface().mean.colors_srgb)
    EXPECT_FALSE(colour[2] > colour[0] && colour[0] > 0.7f) << colour[0] << " " << colour[2];
}

TEST(ScanTemplate, NamesAMissingLandmark) {
  Landmarks marks = test::marks_of(test::half_open());
  marks.points.erase(marks.points.begin() + 30);
  EXPECT_THROW_TEXT(scan_template(test::half_open().taken.scan, marks),
                    "landmarks lack point 30, expected 0 to 67 (Multi-PIE)");
}

TEST(DrawCylinder, ShowsTheScanThatTheSurfaceWasCutFrom) {
  const CylinderScan& scan = test::half_open().taken.scan;
  const CylinderScan drawn = draw_cylinder(test::half_open_surface(), skin_of(test::half_open_surface()), scan);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < scan.radius_mm.size(); ++i)
    if (drawn.radius_mm[i] > 0 && scan.radius_mm[i] > 0) {
      sum += std::abs(static_cast<double>(drawn.radius_mm[i]) - static_cast<double>(scan.radius_mm[i]));
      ++count;
    }
  EXPECT_GT(count, 5000);
  EXPECT_LT(sum / count, 0.3);  // noise of 0.1 mm, and cells of two pixels
}

TEST(MatchCylinder, FollowsAnOpeningMouth) {
  const test::ScannedFace wide = test::scan_face(test::face_of({{"jawOpen", 0.4f}}));
  const MeshPoints start = skin_of(test::half_open_surface());
  const MatchCylinderResult found = matched(test::half_open_surface(), start, wide.taken.scan);
  EXPECT_GT(found.sampled, 0.8);
  EXPECT_LT(median_distance(found.shape, test::truth_of(wide)), 0.5);
  EXPECT_GT(median_distance(start, test::truth_of(wide)), 0.05);
}

double widest_gap_mm(const MorphableModel& surface, const MeshPoints& shape) {
  double widest = 0;
  for (const LipPair& pair : lip_pairs(surface, mouth_loop(surface))) {
    const Vec3f &p = shape.points_mm[pair.upper], &q = shape.points_mm[pair.lower];
    widest = std::max<double>(widest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
  }
  return widest;
}

TEST(MatchCylinder, ShutsAllOfAMouthThatTheScanShowsShut) {
  const test::ScannedFace rest = test::scan_face(test::face_of({}));
  const MorphableModel& surface = test::half_open_surface();
  EXPECT_GT(widest_gap_mm(surface, skin_of(surface)), 5);
  const MatchCylinderResult found = matched(surface, skin_of(surface), rest.taken.scan);
  EXPECT_LT(widest_gap_mm(surface, found.shape), 0.01);
}

TEST(MatchCylinder, LeavesAMouthOpenThatTheScanShowsOpen) {
  const test::ScannedFace ajar = test::scan_face(test::face_of({{"jawOpen", 0.15f}}));
  const MorphableModel& surface = test::half_open_surface();
  const double truly_mm = widest_gap_mm(surface, test::truth_of(ajar));
  EXPECT_GT(truly_mm, 3);
  EXPECT_NEAR(widest_gap_mm(surface, matched(surface, skin_of(surface), ajar.taken.scan).shape), truly_mm, 2);
}

TEST(MatchCylinder, FillsWhatTheFlowDoesNotReach) {
  const MorphableModel& surface = test::half_open_surface();
  const MeshPoints start = skin_of(surface);
  const CylinderScan& scan = test::half_open().taken.scan;
  const CylinderScan drawn = draw_cylinder(surface, start, scan);
  FlowField still{scan.picture.width, scan.picture.height, {}, {}};
  still.displacement_px.assign(scan.radius_mm.size(), Vec2f{0, 0});
  still.valid.assign(scan.radius_mm.size(), 1);
  for (std::size_t i = 0; i < still.valid.size(); i += 7) still.valid[i] = 0;
  const MatchCylinderResult found = match_cylinder(surface, start, drawn, scan, still);
  EXPECT_LT(found.sampled, 0.95);
  EXPECT_LT(median_distance(found.shape, start), 0.2);
  for (const Vec3f& p : found.shape.points_mm) ASSERT_TRUE(std::isfinite(p[0] + p[1] + p[2]));
}

TEST(MatchCylinder, WantsTheSkinAndNothingElse) {
  const MorphableModel& surface = test::half_open_surface();
  MeshPoints start = skin_of(surface);
  const std::size_t skin = start.points_mm.size();
  start.points_mm.pop_back();
  EXPECT_THROW_TEXT(
      draw_cylinder(surface, start, test::half_open().taken.scan),
      "shape has " + std::to_string(skin - 1) + " vertices, the surface's skin has " + std::to_string(skin));
}

TEST(OrientShape, UndoesATurnOfTheHead) {
  const MorphableModel& surface = test::half_open_surface();
  MeshPoints moved = skin_of(surface);
  const float c = std::cos(0.1f), s = std::sin(0.1f);
  for (Vec3f& p : moved.points_mm) p = {c * p[0] + s * p[2] + 3, p[1] - 2, -s * p[0] + c * p[2] + 1};
  EXPECT_LT(median_distance(orient_shape(moved, surface).shape, skin_of(surface)), 1e-3);
}

TEST(OrientShape, IsNotMovedByTheJaw) {
  const MorphableModel& surface = test::half_open_surface();
  MeshPoints open = skin_of(surface);
  const float chin = surface.mean.points_mm[surface.landmarks68[30]][1];
  for (Vec3f& p : open.points_mm)
    if (p[1] < chin) p[1] -= 10;
  const OrientShapeResult rest = orient_shape(open, surface);
  for (std::size_t v = 0; v < open.points_mm.size(); ++v)
    if (open.points_mm[v][1] > chin) {
      ASSERT_NEAR(rest.shape.points_mm[v][1], open.points_mm[v][1], 1e-3);
    }
}

// Shapes of graded opening by their truth, as a space to search.
ShapeModel opening_space() {
  std::vector<MeshPoints> shapes;
  for (const float open : {0.0f, 0.12f, 0.25f, 0.4f, 0.55f})
    shapes.push_back(test::truth_of(test::scan_face(test::face_of({{"jawOpen", open}}), 64)));
  return region_pca(shapes, nullptr);
}

TEST(ClosestCombination, FindsHowFarAMouthIsOpen) {
  const ShapeModel space = opening_space();
  const test::ScannedFace wide = test::scan_face(test::face_of({{"jawOpen", 0.7f}}));  // beyond the examples
  const ClosestCombinationResult found = closest_combination(wide.taken.scan, test::half_open_surface(), &space);
  EXPECT_LT(median_distance(found.shape, test::truth_of(wide)), 0.5);
  const ClosestCombinationResult none = closest_combination(wide.taken.scan, test::half_open_surface(), nullptr);
  EXPECT_LT(found.difference, 0.8 * none.difference);
}

TEST(ClosestCombination, TakesCoefficientsByHand) {
  const ShapeModel space = opening_space();
  const ClosestCombinationResult found =
      closest_combination(test::half_open().taken.scan, test::half_open_surface(), &space, {.by_hand = {1.5}});
  EXPECT_EQ(found.coefficients.values[0], 1.5f);
  const std::vector<double> shape = shape_of(space, {1.5 * space.sigmas_mm[0]});
  EXPECT_FLOAT_EQ(found.shape.points_mm[10][1], static_cast<float>(shape[31]));
}

TEST(BatchFlags, DealsOutByLikeness) {
  std::vector<std::string> first;
  for (const std::int64_t batch : {1, 2, 3}) {
    std::string in;
    engine::SeqWriter<bool> writer([&](const std::string& id, bool flag) {
      if (flag) in += id;
    });
    batch_flags({{0.5, 0.1, 0.3, 0.2, 0.4}, {"a", "b", "c", "d", "e"}}, writer, {.batch = batch});
    first.push_back(in);
  }
  EXPECT_EQ(first, (std::vector<std::string>{"bd", "ce", "a"}));
}

test::ScannedFace grinning() {
  return test::scan_face(test::face_of({{"jawOpen", 0.3f},
                                        {"mouthUpperUpLeft", 0.9f},
                                        {"mouthUpperUpRight", 0.9f},
                                        {"mouthLowerDownLeft", 0.9f},
                                        {"mouthLowerDownRight", 0.9f}}),
                         384);
}

TEST(AddTeeth, TakesALostPixelForNoGap) {
  const test::ScannedFace grin = grinning();
  const MeshPoints shape = test::truth_of(grin);
  const auto whole = [&](const CylinderScan& scan) {
    return add_teeth(test::half_open_surface(), {std::vector<CylinderScan>{scan}}, {std::vector<MeshPoints>{shape}});
  };
  const MorphableModel before = whole(grin.taken.scan);
  const Part& teeth = before.mean.parts[1];
  const std::uint32_t tooth =
      before.mean.corners[before.mean.polygon_starts[teeth.first_polygon + teeth.polygon_count / 2]];
  CylinderScan lost = grin.taken.scan;
  const CylinderPixel at = cylinder_pixel(lost, before.mean.points_mm[tooth]);
  const auto pixel = static_cast<std::size_t>(std::lround(at.y_px)) * static_cast<std::size_t>(lost.picture.width) +
                     static_cast<std::size_t>(std::lround(at.x_px));
  lost.radius_mm[pixel] = 0;
  for (std::size_t k = 0; k < 3; ++k) lost.picture.pixels[3 * pixel + k] = 0;
  const MorphableModel after = whole(lost);
  EXPECT_EQ(after.mean.parts[1].polygon_count, teeth.polygon_count);
  EXPECT_LT(std::abs(after.mean.points_mm[tooth][2] - before.mean.points_mm[tooth][2]), 0.5);
}

TEST(AddTeeth, HangsTheLowerOnesOnTheChin) {
  const test::ScannedFace grin = grinning();
  const MorphableModel& surface = test::half_open_surface();
  const MeshPoints shape = test::truth_of(grin);
  const MorphableModel whole =
      add_teeth(surface, {std::vector<CylinderScan>{grin.taken.scan}}, {std::vector<MeshPoints>{shape}});
  ASSERT_EQ(whole.mean.parts.size(), 4u);
  EXPECT_EQ(whole.mean.parts[1].name, upper_teeth_part);
  EXPECT_EQ(whole.mean.parts[2].name, lower_teeth_part);
  EXPECT_EQ(whole.mean.parts[3].name, mouth_part);
  // The chin goes down by 5 mm: lower teeth with it, upper ones not, the throat hardly.
  MeshPoints open = skin_of(surface);
  for (Vec3f& p : open.points_mm) p[1] -= 5;
  const std::vector<Vec3f> posed = head_points(whole, open.points_mm);
  const auto moved = [&](std::size_t part) {
    const std::uint32_t v = whole.mean.corners[whole.mean.polygon_starts[whole.mean.parts[part].first_polygon]];
    return posed[v][1] - whole.mean.points_mm[v][1];
  };
  EXPECT_FLOAT_EQ(moved(1), 0);
  EXPECT_NEAR(moved(2), -5, 1e-4);
  EXPECT_EQ(posed.back(), whole.mean.points_mm.back());
}

TEST(AddTeeth, NamesAScanThatIsNotThere) {
  EXPECT_THROW_TEXT(
      add_teeth(test::half_open_surface(), {std::vector<CylinderScan>{test::half_open().taken.scan}, {"open"}},
                {std::vector<MeshPoints>{skin_of(test::half_open_surface())}, {"open"}},
                {.upper = "grin", .lower = ""}),
      "scans has no element \"grin\"; the first is \"open\"");
}

TEST(ResampleShape, IsTheIdentityInItsOwnTopology) {
  const MorphableModel& surface = test::half_open_surface();
  const MeshPoints mean = skin_of(surface);
  MeshPoints person = mean;
  for (Vec3f& p : person.points_mm) p = {1.1f * p[0], p[1] + 2, p[2]};
  const Image texture{static_cast<int>(mean.points_mm.size()), 1, 3,
                      std::vector<std::uint8_t>(3 * mean.points_mm.size(), 77)};
  const ResampleShapeResult found = resample_shape(person, texture, surface, mean, mean);
  EXPECT_LT(median_distance(found.shape, person), 0.02);
  EXPECT_EQ(found.texture.pixels[5], 77);
}

TEST(AddExpression, IsADifferenceOfShapes) {
  const MeshPoints smiling{{{1, 2, 3}}}, neutral{{{1, 1, 1}}}, other{{{10, 20, 30}}};
  EXPECT_EQ(add_expression(smiling, neutral, other).points_mm[0], (Vec3f{10, 21, 32}));
  EXPECT_THROW_TEXT(add_expression(smiling, neutral, {}), "shapes have 1, 1 and 0 vertices, expected equal counts");
}

TEST(MeanShape, IsTheMean) {
  EXPECT_EQ(mean_shape({std::vector<MeshPoints>{{{{1, 2, 3}}}, {{{3, 2, 1}}}}}).points_mm[0], (Vec3f{2, 2, 2}));
}

// A model from planted shapes of known spread.
class FromScans : public testing::Test {
 protected:
  FromScans() {
    const MorphableModel& surface = test::half_open_surface();
    neutral_ = skin_of(surface);
    for (const float a : {-1.0f, 0.0f, 1.0f})
      for (const float b : {-1.0f, 1.0f}) {
        MeshPoints person = neutral_, face = neutral_;
        for (Vec3f& p : person.points_mm) p[0] *= 1 + 0.05f * a, p[1] *= 1 + 0.02f * b;
        for (Vec3f& p : face.points_mm)
          if (p[1] < -20) p[1] += 3 * a, p[2] += b;
        persons_.push_back(person);
        faces_.push_back(face);
        textures_.push_back(
            {static_cast<int>(neutral_.points_mm.size()), 1, 3,
             std::vector<std::uint8_t>(3 * neutral_.points_mm.size(), static_cast<std::uint8_t>(150 + 40 * a))});
      }
  }
  MeshPoints neutral_;
  std::vector<MeshPoints> persons_, faces_;
  std::vector<Image> textures_;
};

TEST_F(FromScans, KeepsPersonsAndExpressionsApart) {
  const MorphableModel& surface = test::half_open_surface();
  const MorphableModel model = from_scans(surface, faces_, neutral_, persons_, textures_);
  EXPECT_EQ(model.identity.size(), 2u);
  EXPECT_EQ(model.expression.size(), 2u);
  EXPECT_EQ(model.albedo.size(), 1u);
  // Coefficient 1 is one standard deviation: sqrt(2/3) of 5 % in width, which is the larger one.
  const std::size_t v = static_cast<std::size_t>(
      std::max_element(neutral_.points_mm.begin(), neutral_.points_mm.end()) - neutral_.points_mm.begin());
  EXPECT_NEAR(std::abs(model.identity.modes[v][0]), std::sqrt(2.0 / 3) * 0.05 * neutral_.points_mm[v][0], 1e-3);
  const Rig rig = head_rig(model);
  EXPECT_EQ(rig.shapes.size(), arkit_count + 2);
}

TEST_F(FromScans, ComparesSpacesAsTheyWerePlanted) {
  // Every expression lies outside what persons span.
  const Table table = compare_shapes(test::half_open_surface(), faces_, persons_);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_GT(table.rows[0].values[2], 0.3);
  EXPECT_LT(table.rows[1].values[2], 1e-9);  // other mixtures of the same two directions
}

TEST_F(FromScans, WantsATexturePerPerson) {
  textures_.pop_back();
  EXPECT_THROW_TEXT(from_scans(test::half_open_surface(), faces_, neutral_, persons_, textures_),
                    "there are 6 identities and 5 textures");
}

TEST_F(FromScans, MakesARigOfTheScannedPerson) {
  std::vector<std::string> ids;
  engine::SeqWriter<Weights> poses([&](const std::string& id, const Weights& weights) {
    ids.push_back(id);
    EXPECT_EQ(weights.values.size(), arkit_count + 1);
  });
  const Rig rig = scanned_rig(test::half_open_surface(), {std::vector<MeshPoints>{faces_[0]}, {"oo"}}, neutral_, poses);
  EXPECT_EQ(ids, std::vector<std::string>{"oo"});
  EXPECT_EQ(rig.shapes.back().name, "oo");
}

}  // namespace
}  // namespace face::model
