// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/make_person.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "nodes/base/mouth.h"
#include "nodes/phantom/eyelids.h"
#include "nodes/phantom/identity_modes.h"
#include "nodes/phantom/skin_layout.h"
#include "tests/nodes/phantom/head_probe.h"
#include "tests/support/expect_throw_text.h"

namespace {

using face::Rig;
using face::ShapeSet;
using face::Vec3f;
using namespace face::phantom;
using namespace probe;

const ShapeSet& modes() {
  static const ShapeSet set = identity_modes();
  return set;
}

MakePersonOptions plain() {
  MakePersonOptions options;
  options.spread = 0;
  options.skin = options.moles = false;
  return options;
}

MakePersonOptions warped(std::int64_t seed, double warp_mm) {
  MakePersonOptions options;
  options.seed = seed;
  options.warp_mm = warp_mm;
  return options;
}

MakePersonResult person(const MakePersonOptions& options) { return make_person(head(), &modes(), nullptr, options); }

face::Weights weights_of(Pose pose) {
  face::Weights weights;
  weights.values.assign(face::arkit_count, 0.0f);
  for (const auto& [name, weight] : pose) weights.values[face::arkit_index(name)] = weight;
  return weights;
}

void expect_equal(const Rig& a, const Rig& b) {
  EXPECT_EQ(a.neutral.points_mm, b.neutral.points_mm);
  EXPECT_EQ(a.neutral.colors_srgb, b.neutral.colors_srgb);
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (std::size_t s = 0; s < a.shapes.size(); ++s) EXPECT_EQ(a.shapes[s].offsets_mm, b.shapes[s].offsets_mm) << s;
}

TEST(MakePerson, IsTheRigItselfWithEverySwitchOff) {
  const MakePersonResult result = person(plain());
  expect_equal(result.person, head());
  EXPECT_TRUE(result.dots.dots.empty());
  EXPECT_TRUE(result.markers.dots.empty());
  EXPECT_EQ(result.warp_mm.rows, 0u);
  for (const double c : result.coefficients.values) EXPECT_EQ(c, 0);
}

TEST(MakePerson, IsTheSameForASeedAndAnotherForAnother) {
  const MakePersonResult a = person(warped(4, 2)), b = person(warped(4, 2)), c = person(warped(5, 2));
  expect_equal(a.person, b.person);
  EXPECT_EQ(a.coefficients.values, b.coefficients.values);
  EXPECT_EQ(a.dots.dots.size(), b.dots.dots.size());
  EXPECT_NE(a.person.neutral.points_mm, c.person.neutral.points_mm);
  EXPECT_NE(a.person.neutral.colors_srgb, c.person.neutral.colors_srgb);
}

TEST(MakePerson, TellsPersonsApartByTheirIds) {
  const std::string one = "one", two = "two";
  const MakePersonOptions options;
  const auto points = [&](const std::string* id) {
    return make_person(head(), &modes(), id, options).person.neutral.points_mm;
  };
  EXPECT_EQ(points(&one), points(&one));
  EXPECT_NE(points(&one), points(&two));
}

TEST(MakePerson, IsTheNeutralPlusItsModesWithoutAWarp) {
  const MakePersonResult result = person(warped(7, 0));
  ASSERT_EQ(result.coefficients.columns, modes().shapes.size());
  std::vector<Vec3f> expected = head().neutral.points_mm;
  for (std::size_t k = 0; k < modes().shapes.size(); ++k)
    face::add_shape(modes().shapes[k], static_cast<float>(result.coefficients.at(0, k)), expected);
  EXPECT_EQ(result.person.neutral.points_mm, expected);
  // The shapes are the rig's own, but for the blinks.
  for (std::size_t s = 0; s < head().shapes.size(); ++s)
    if (!head().shapes[s].name.starts_with("eyeBlink")) {
      EXPECT_EQ(result.person.shapes[s].offsets_mm, head().shapes[s].offsets_mm) << head().shapes[s].name;
    }
}

TEST(MakePerson, HasCoefficientsOfStandardDeviationOne) {
  double sum = 0, squares = 0, count = 0;
  MakePersonOptions options = plain();
  options.spread = 1;
  for (options.seed = 1; options.seed <= 40; ++options.seed) {
    const std::vector<double> values = person(options).coefficients.values;
    for (const double c : values) {
      sum += c;
      squares += c * c;
      EXPECT_LE(std::abs(c), 2.5);
    }
    count += static_cast<double>(values.size());
  }
  // 3,040 numbers: three standard errors. A normal cut at 2.5 has a variance of 0.911.
  EXPECT_NEAR(sum / count, 0, 3 / std::sqrt(count));
  EXPECT_NEAR(squares / count, 0.911, 3 * std::sqrt(2 / count));
}

TEST(MakePerson, IsWarpedByTheGivenAmount) {
  for (const double warp_mm : {1.0, 3.0}) {
    const MakePersonResult result = person(warped(3, warp_mm));
    ASSERT_EQ(result.warp_mm.rows, head().neutral.points_mm.size());
    double squares = 0;
    const std::vector<std::uint32_t> face = part_vertices("face");
    for (const std::uint32_t v : face)
      for (std::size_t k = 0; k < 3; ++k) squares += result.warp_mm.at(v, k) * result.warp_mm.at(v, k);
    // Eyes and mouth keep their solids, so that it is a little less about them.
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(face.size())), warp_mm, 0.1 * warp_mm);
  }
}

TEST(MakePerson, HasAWarpThatNoCombinationOfModesMakes) {
  // What least squares by the modes leave of the warp over the skin, by Gram-Schmidt: most of it.
  const MakePersonResult result = person(warped(3, 2));
  const std::vector<std::uint32_t> face = part_vertices("face");
  const auto on_face = [&](const std::vector<Vec3f>& offsets) {
    std::vector<double> values;
    for (const std::uint32_t v : face)
      for (std::size_t k = 0; k < 3; ++k) values.push_back(offsets[v][k]);
    return values;
  };
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  std::vector<double> left;
  for (const std::uint32_t v : face)
    for (std::size_t k = 0; k < 3; ++k) left.push_back(result.warp_mm.at(v, k));
  const double before = std::sqrt(dot(left, left));
  std::vector<std::vector<double>> basis;
  const auto remove_basis = [&](std::vector<double>& values) {
    for (const std::vector<double>& direction : basis) {
      const double along = dot(values, direction);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] -= along * direction[i];
    }
  };
  for (const face::Shape& mode : modes().shapes) {
    std::vector<Vec3f> offsets(head().neutral.points_mm.size(), {0, 0, 0});
    face::add_shape(mode, 1, offsets);
    std::vector<double> values = on_face(offsets);
    const double length = std::sqrt(dot(values, values));
    remove_basis(values);
    const double rest = std::sqrt(dot(values, values));
    if (!(rest > 1e-3 * length)) continue;  // moves ears or hair alone
    for (double& x : values) x /= rest;
    basis.push_back(values);
  }
  remove_basis(left);
  EXPECT_GT(std::sqrt(dot(left, left)) / before, 0.5);
}

TEST(MakePerson, ShutsItsLipsOnAnyJaw) {
  for (const std::int64_t seed : {1, 2, 3, 4, 5, 6}) {
    const Rig rig = person(warped(seed, 3)).person;
    for (const float w : {0.15f, 0.5f, 1.0f}) {
      const face::LipGap gap =
          face::lip_gap(rig, face::pose_points(rig, weights_of({{"jawOpen", w}, {"mouthClose", w}})));
      EXPECT_NEAR(gap.max_mm, 0, 2e-4) << seed;  // float positions of 100 mm
      EXPECT_NEAR(gap.min_mm, 0, 2e-4) << seed;
    }
    for (const face::LipPair& pair : rig.inner_lips)
      EXPECT_LT(distance(rig.neutral.points_mm[pair.upper], rig.neutral.points_mm[pair.lower]), 1e-3);
  }
}

TEST(MakePerson, OpensTheMouthAsWideAsTheRigNearly) {
  const double of_rig = face::lip_gap_mm(head(), posed({{"jawOpen", 1}}));
  for (const std::int64_t seed : {1, 2, 3, 4}) {
    const Rig rig = person(warped(seed, 2)).person;
    EXPECT_NEAR(face::lip_gap_mm(rig, face::pose_points(rig, weights_of({{"jawOpen", 1}}))) / of_rig, 1, 0.15);
  }
}

TEST(MakePerson, ShutsItsEyesOverTheBalls) {
  HeadBuilder builder;
  const Skin skin = add_skin(builder);
  for (const std::int64_t seed : {1, 2, 3, 4, 5, 6}) {
    const Rig rig = person(warped(seed, 2)).person;
    const std::vector<Vec3f> points = face::pose_points(rig, weights_of({{"eyeBlinkLeft", 1}, {"eyeBlinkRight", 1}}));
    const std::vector<Vec3f> of_rig = posed({{"eyeBlinkLeft", 1}, {"eyeBlinkRight", 1}});
    double widest = 0, widest_of_rig = 0;
    for (int c = 4; c <= 22; ++c) {
      const std::uint32_t upper = skin.left_eye(0, c), lower = skin.left_eye(0, kEyeColumns - c);
      widest = std::max(widest, double{points[upper][1]} - points[lower][1]);
      widest_of_rig = std::max(widest_of_rig, double{of_rig[upper][1]} - of_rig[lower][1]);
    }
    EXPECT_LT(widest, widest_of_rig + 0.25) << seed;
    // No lid is inside the ball: its middle is that of the white's box in x and y, its radius that of its mode.
    Vec3f middle = {0, 0, 0};
    const std::vector<std::uint32_t> ball = part_vertices("sclera_left");
    for (const std::uint32_t v : ball)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += rig.neutral.points_mm[v][k] / static_cast<float>(ball.size());
    Vec3f at_rest = {0, 0, 0};
    for (const std::uint32_t v : ball)
      for (std::size_t k = 0; k < 3; ++k)
        at_rest[k] += head().neutral.points_mm[v][k] / static_cast<float>(ball.size());
    double radius = 0, radius_at_rest = 0;
    for (const std::uint32_t v : ball) {
      radius = std::max(radius, distance(rig.neutral.points_mm[v], middle));
      radius_at_rest = std::max(radius_at_rest, distance(head().neutral.points_mm[v], at_rest));
    }
    const double scale = radius / radius_at_rest;
    Vec3f centre;
    for (std::size_t k = 0; k < 3; ++k) {
      const double from[3] = {kEyeCentre.x, kEyeCentre.y, kEyeCentre.z};
      centre[k] = static_cast<float>(middle[k] + scale * (from[k] - at_rest[k]));  // the warp's turn is below 2 degrees
    }
    for (int c = 0; c < kEyeColumns; ++c)
      for (int ring = -1; ring <= 3; ++ring)
        EXPECT_GT(distance(points[skin.left_eye(ring, c)], centre), scale * kEyeRadius - 0.15) << seed;
  }
}

TEST(MakePerson, KeepsTeethSolidInEveryPose) {
  const Rig rig = person(warped(2, 4)).person;
  const std::vector<Vec3f> open = face::pose_points(rig, weights_of({{"jawOpen", 1}}));
  const std::vector<Vec3f> rest_open = posed({{"jawOpen", 1}});
  const std::vector<std::uint32_t> teeth = part_vertices("teeth");
  for (std::size_t k = 0; k < teeth.size(); k += 11)
    for (std::size_t j = k + 5; j < std::min(k + 60, teeth.size()); j += 9) {
      EXPECT_NEAR(distance(rig.neutral.points_mm[teeth[k]], rig.neutral.points_mm[teeth[j]]),
                  distance(head().neutral.points_mm[teeth[k]], head().neutral.points_mm[teeth[j]]), 1e-3);
      EXPECT_NEAR(distance(open[teeth[k]], open[teeth[j]]), distance(rest_open[teeth[k]], rest_open[teeth[j]]), 1e-3);
    }
}

TEST(MakePerson, SetsTeethBackBehindLipsThatCameTooNear) {
  // A mode of the skin alone, as scans give them: the lips go back by 6 mm and the teeth stay.
  face::Shape thin_lips;
  thin_lips.name = "thin_lips";
  for (const std::uint32_t v : part_vertices("face")) {
    thin_lips.vertices.push_back(v);
    thin_lips.offsets_mm.push_back({0, 0, -6});
  }
  const ShapeSet set = {{thin_lips}};
  MakePersonOptions options = plain();
  options.spread = 1;
  bool seen = false;
  for (options.seed = 1; options.seed <= 6; ++options.seed) {
    const MakePersonResult result = make_person(head(), &set, nullptr, options);
    const double lips_mm = -6 * result.coefficients.at(0, 0);
    const std::uint32_t tooth = head().upper_teeth[0];
    const double teeth_mm = double{result.person.neutral.points_mm[tooth][2]} - head().neutral.points_mm[tooth][2];
    EXPECT_NEAR(teeth_mm, std::min(0.0, lips_mm + 0.5), 1e-4) << options.seed;
    seen = seen || teeth_mm < -1;
  }
  EXPECT_TRUE(seen);
}

TEST(MakePerson, DrawsEveryPartByItself) {
  MakePersonOptions bare = warped(9, 1), dressed = bare;
  bare.skin = bare.moles = false;
  dressed.lipstick = true;
  dressed.markers = Markers::white;
  const MakePersonResult a = person(bare), b = person(dressed);
  EXPECT_EQ(a.person.neutral.points_mm, b.person.neutral.points_mm);
  MakePersonOptions unwarped = dressed;
  unwarped.warp_mm = 0;
  EXPECT_EQ(person(unwarped).person.neutral.colors_srgb, b.person.neutral.colors_srgb);
}

TEST(MakePerson, PaintsTheLipsUpToTheirEdgeWithLipstick) {
  MakePersonOptions options = plain();
  options.lipstick = true;
  const Rig rig = person(options).person;
  const auto color = [&](std::uint32_t v) { return rig.neutral.colors_srgb[v]; };
  // The middle of both lips is red, the skin a few millimetres away is as before.
  const std::uint32_t upper = head().landmarks68[62], nose = head().landmarks68[33], chin = head().landmarks68[8];
  EXPECT_GT(color(upper)[0], 2.5f * color(upper)[1]);
  EXPECT_EQ(color(nose), head().neutral.colors_srgb[nose]);
  EXPECT_EQ(color(chin), head().neutral.colors_srgb[chin]);
}

TEST(MakePerson, KeepsColoursInRangeWithEveryLook) {
  for (const std::int64_t seed : {1, 2, 3}) {
    MakePersonOptions options = warped(seed, 1);
    options.painted = options.lipstick = true;
    options.beard = 1;
    for (const Vec3f& color : person(options).person.neutral.colors_srgb)
      for (const float c : color) {
        EXPECT_GE(c, 0.0f);
        EXPECT_LE(c, 1.0f);
      }
  }
}

TEST(MakePerson, GluesMarkersOnByName) {
  MakePersonOptions options = plain();
  options.markers = Markers::black;
  const MakePersonResult result = person(options);
  EXPECT_EQ(result.markers.dots.size(), 55u);
  EXPECT_EQ(result.dots.dots.size(), 55u);
  std::set<std::string> names;
  const auto place = [&](const std::string& name) {
    for (const face::SurfaceDot& dot : result.markers.dots)
      if (dot.name == name) {
        Vec3f at = {0, 0, 0};
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t k = 0; k < 3; ++k) at[k] += dot.weights[c] * head().neutral.points_mm[dot.vertices[c]][k];
        return at;
      }
    ADD_FAILURE() << name << " is missing";
    return Vec3f{0, 0, 0};
  };
  for (const face::SurfaceDot& dot : result.markers.dots) {
    EXPECT_TRUE(names.insert(dot.name).second) << dot.name;
    EXPECT_NEAR(dot.weights[0] + dot.weights[1] + dot.weights[2], 1, 1e-5);
    EXPECT_LT(dot.color_srgb[0], 0.1f);
    if (!dot.name.ends_with("_right")) continue;
    const Vec3f right = place(dot.name), left = place(dot.name.substr(0, dot.name.size() - 6) + "_left");
    EXPECT_NEAR(right[0], -left[0], 0.01) << dot.name;
    EXPECT_NEAR(right[1], left[1], 0.01) << dot.name;
    EXPECT_NEAR(right[2], left[2], 0.5) << dot.name;  // the diagonals of quads are not mirrored
  }
  // Markers lie apart: none covers another.
  for (const face::SurfaceDot& a : result.markers.dots)
    for (const face::SurfaceDot& b : result.markers.dots)
      if (a.name < b.name) {
        EXPECT_GT(distance(place(a.name), place(b.name)), 4) << a.name << " " << b.name;
      }
}

TEST(MakePerson, NeedsLandmarksForASkin) {
  Rig rig = head();
  rig.landmarks68.clear();
  EXPECT_THROW_TEXT(make_person(rig, nullptr, nullptr),
                    "the rig has 0 landmarks, expected 68: skin, dots and markers are placed by them");
  EXPECT_NO_THROW(make_person(rig, &modes(), nullptr, plain()));
}

TEST(MakePerson, RejectsModesOfAnotherHead) {
  MakeHeadOptions bald;
  bald.with_hair = false;
  const Rig rig = make_head(bald);
  EXPECT_THROW(make_person(rig, &modes(), nullptr), face::Error);
  MakePersonOptions options;
  options.spread = -1;
  EXPECT_THROW_TEXT(person(options), "spread is -1, expected at least 0");
}

}  // namespace
