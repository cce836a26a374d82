// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/match_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "nodes/align/orient.h"
#include "nodes/model/motion_basis.h"
#include "nodes/model/scan_surface.h"
#include "nodes/phantom/identity_modes.h"
#include "tests/nodes/model/scans_material.h"
#include "tests/support/expect_throw_text.h"

namespace face::model {
namespace {

struct Person {
  phantom::MakePersonResult made;
  phantom::LaserScanResult taken;
};

// A neutral person, scanned at 256 x 256, as build.json's are; shifted by so much.
Person person_of(const std::string& id, float shift_mm = 0) {
  static const ShapeSet modes = phantom::identity_modes();
  phantom::MakePersonResult made =
      phantom::make_person(phantom::make_head(), &modes, &id, {.seed = 31, .warp_mm = 0.7, .moles = false});
  for (Vec3f& p : made.person.neutral.points_mm) p[1] += shift_mm;
  phantom::LaserScanResult taken =
      phantom::laser_scan(made.person, test::face_of({}), nullptr, &id, {.rows = 256, .columns = 256, .step_mm = 1.2});
  return {std::move(made), std::move(taken)};
}

const Person& reference() {
  static const Person person = person_of("1");
  return person;
}

const MorphableModel& surface() {
  static const MorphableModel cut =
      scan_template(reference().taken.scan,
                    phantom::laser_landmarks(reference().made.person, test::face_of({}), reference().taken.scan),
                    {.row_step_px = 3, .column_step_px = 2, .half_angle_deg = 116});
  return cut;
}

MeshPoints truth_of(const Person& person) {
  return phantom::laser_truth(person.made.person, test::face_of({}), reference().taken.truth, surface());
}

std::array<double, 3> doubles(const Vec3f& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

// Median distance after the rigid motion that makes it least.
double off_mm(const MeshPoints& found, const MeshPoints& truth) {
  std::vector<std::array<double, 3>> from, to;
  for (std::size_t v = 0; v < truth.points_mm.size(); ++v) {
    from.push_back(doubles(found.points_mm[v]));
    to.push_back(doubles(truth.points_mm[v]));
  }
  const align::AbsoluteOrientation laid = align::absolute_orientation(from, to, std::vector<double>(from.size(), 1.0));
  std::vector<double> all;
  for (std::size_t v = 0; v < from.size(); ++v) {
    double squared = 0;
    for (std::size_t r = 0; r < 3; ++r) {
      double at = laid.to_from.translation_mm[r];
      for (std::size_t c = 0; c < 3; ++c) at += laid.to_from.rotation[3 * r + c] * from[v][c];
      squared += (at - to[v][r]) * (at - to[v][r]);
    }
    all.push_back(std::sqrt(squared));
  }
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

MeshPoints skin() {
  return {{surface().mean.points_mm.begin(),
           surface().mean.points_mm.begin() + static_cast<std::ptrdiff_t>(skin_count(surface()))}};
}

MatchMotionResult matched(const Person& person, const MeshPoints* start = nullptr,
                          const MatchMotionOptions& options = {}) {
  return match_motion(surface(), reference().taken.scan, start, person.taken.scan, options);
}

TEST(MatchMotion, LeavesTheReferenceWhereItIs) {
  const MatchMotionResult found = matched(reference());
  EXPECT_GT(found.sampled, 0.9);
  EXPECT_LT(off_mm(found.shape, skin()), 0.2);  // noise of 0.1 mm, and radii smoothed by 1.2 mm
  EXPECT_EQ(found.texture.pixels.size(), 3 * found.shape.points_mm.size());
}

TEST(MatchMotion, FindsThePlacesOfAnotherHead) {
  const Person other = person_of("2");
  const double before = off_mm(skin(), truth_of(other)), after = off_mm(matched(other).shape, truth_of(other));
  EXPECT_GT(before, 2.5);
  EXPECT_LT(after, 0.6 * before);
}

TEST(MatchMotion, BeginsWhereItIsTold) {
  const Person there = person_of("2"), lower = person_of("2", -9);
  MeshPoints start = skin();
  for (Vec3f& p : start.points_mm) p[1] -= 8;
  const MeshPoints here = matched(there).shape, low = matched(lower, &start).shape;
  std::vector<double> fall;
  for (std::size_t v = 0; v < here.points_mm.size(); ++v)
    fall.push_back(static_cast<double>(here.points_mm[v][1]) - static_cast<double>(low.points_mm[v][1]));
  std::nth_element(fall.begin(), fall.begin() + static_cast<std::ptrdiff_t>(fall.size() / 2), fall.end());
  EXPECT_NEAR(fall[fall.size() / 2], 9, 0.5);
}

TEST(MatchMotion, EndsAtTheSamePlacesFromAnotherStart) {
  const Person other = person_of("2");
  MeshPoints start = skin();
  for (Vec3f& p : start.points_mm) p[1] += 3, p[0] *= 1.02f;
  EXPECT_LT(off_mm(matched(other, &start).shape, matched(other).shape), 0.35);
}

TEST(MatchMotion, ComesNearerToFeaturesWithTheirColours) {
  const Person other = person_of("3");
  const auto lips_off = [&](double reach_mm) {
    const MeshPoints found = matched(other, nullptr, {.feature_reach_mm = reach_mm}).shape, truth = truth_of(other);
    double sum = 0;
    for (std::size_t mark = 48; mark < 60; ++mark) {
      const Vec3f &p = found.points_mm[surface().landmarks68[mark]], &q = truth.points_mm[surface().landmarks68[mark]];
      sum += std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    }
    return sum / 12;
  };
  EXPECT_LT(lips_off(12), lips_off(0));
}

TEST(MatchMotion, StaysAtTheSurfaceWhereTheScanShowsNothing) {
  Person nobody = reference();
  std::fill(nobody.taken.scan.radius_mm.begin(), nobody.taken.scan.radius_mm.end(), 0.0f);
  const MatchMotionResult found = matched(nobody);
  EXPECT_EQ(found.sampled, 0);
  EXPECT_EQ(found.shape.points_mm, skin().points_mm);
}

TEST(MatchMotion, WantsAStartOfTheSkin) {
  MeshPoints start = skin();
  start.points_mm.pop_back();
  const std::string count = std::to_string(start.points_mm.size());
  EXPECT_THROW_TEXT(matched(reference(), &start), "start has " + count + " vertices, the surface's skin has " +
                                                      std::to_string(start.points_mm.size() + 1));
}

std::vector<Vec3f> patch() {
  std::vector<Vec3f> places;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j)
      places.push_back(
          {12.0f * static_cast<float>(i), 12.0f * static_cast<float>(j), 90.0f - 0.5f * static_cast<float>(i * i)});
  return places;
}

TEST(MotionBasis, GivesTheSameMotionAtItsPlacesAsAnywhere) {
  const MotionBasis basis(patch(), 0, {.functions = 40});
  std::vector<double> c, row(basis.size());
  for (std::size_t i = 0; i < basis.size(); ++i) c.push_back(std::sin(1.3 * static_cast<double>(i)));
  const auto at_places = basis.displacements(c), anywhere = basis.displacements(patch(), c);
  for (std::size_t i = 0; i < at_places.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(at_places[i][k], anywhere[i][k], 1e-6);
    basis.row(i, {0, 1, 0}, row);
    EXPECT_NEAR(std::inner_product(row.begin(), row.end(), c.begin(), 0.0), at_places[i][1], 1e-9);
  }
}

TEST(MotionBasis, MovesMirrorImagesAlikeWithoutAsymmetry) {
  const MotionBasis basis(patch(), 0, {.asymmetry = 0, .functions = 30});
  std::vector<double> c(basis.size(), 0.0);
  for (std::size_t i = 0; i + 6 < c.size(); ++i) c[i] = std::cos(0.7 * static_cast<double>(i));
  const auto by = basis.displacements({{30, 10, 80}, {-30, 10, 80}}, c);
  EXPECT_GT(std::abs(by[0][0]), 0.1);
  EXPECT_NEAR(by[0][0], -by[1][0], 1e-9);
  EXPECT_NEAR(by[0][1], by[1][1], 1e-9);
  EXPECT_NEAR(by[0][2], by[1][2], 1e-9);
}

TEST(MotionBasis, SpreadsAsFarAsItIsTold) {
  // All functions of a small patch: the variance of its places is the process's own.
  const MotionBasis basis(patch(), 500, {.motion_mm = 3, .asymmetry = 0, .functions = 81});
  std::vector<double> row(basis.size());
  basis.row(7, {0, 0, 1}, row);
  double variance = 0;
  for (std::size_t k = 0; k + 6 < row.size(); ++k) variance += row[k] * row[k];
  EXPECT_NEAR(variance, 9, 0.01);
}

}  // namespace
}  // namespace face::model
