// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/identity_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "nodes/phantom/eyelids.h"
#include "tests/nodes/phantom/head_probe.h"

namespace {

using face::Shape;
using face::ShapeSet;
using face::Vec3f;
using namespace probe;

const ShapeSet& modes() {
  static const ShapeSet set = face::phantom::identity_modes();
  return set;
}

std::vector<Vec3f> dense(const Shape& shape) {
  std::vector<Vec3f> offsets(head().neutral.points_mm.size(), {0, 0, 0});
  for (std::size_t k = 0; k < shape.vertices.size(); ++k) offsets[shape.vertices[k]] = shape.offsets_mm[k];
  return offsets;
}

double dot(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) sum += double{a[v][k]} * b[v][k];
  return sum;
}

bool is_asymmetric(const std::string& name) {
  static const std::size_t first = [] {
    std::size_t k = 0;
    while (modes().shapes.at(k).name != "chin_aside") ++k;
    return k;
  }();
  for (std::size_t k = first; k < modes().shapes.size(); ++k)
    if (modes().shapes[k].name == name) return true;
  return false;
}

TEST(IdentityModes, AreManyWithNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Shape& mode : modes().shapes) EXPECT_TRUE(names.insert(mode.name).second) << mode.name << " occurs twice";
  EXPECT_GE(names.size(), 40u);
}

TEST(IdentityModes, MoveVerticesOfTheHeadByMillimetres) {
  for (const Shape& mode : modes().shapes) {
    ASSERT_EQ(mode.vertices.size(), mode.offsets_mm.size()) << mode.name;
    ASSERT_FALSE(mode.vertices.empty()) << mode.name;
    EXPECT_TRUE(std::is_sorted(mode.vertices.begin(), mode.vertices.end())) << mode.name;
    EXPECT_LT(mode.vertices.back(), head().neutral.points_mm.size()) << mode.name;
    double largest = 0;
    for (const Vec3f& offset : mode.offsets_mm)
      largest = std::max(largest, std::hypot(double{offset[0]}, double{offset[1]}, double{offset[2]}));
    EXPECT_GT(largest, 0.4) << mode.name;
    EXPECT_LT(largest, 7) << mode.name;
  }
}

TEST(IdentityModes, AreIndependent) {
  // Gram-Schmidt: what the modes before it leave of each mode. Rank is full where every share is clearly above 0.
  std::vector<std::vector<Vec3f>> basis;
  double least = 1;
  for (const Shape& mode : modes().shapes) {
    std::vector<Vec3f> left = dense(mode);
    const double before = std::sqrt(dot(left, left));
    for (int pass = 0; pass < 2; ++pass)
      for (const std::vector<Vec3f>& direction : basis) {
        const double along = dot(left, direction);
        for (std::size_t v = 0; v < left.size(); ++v)
          for (std::size_t k = 0; k < 3; ++k) left[v][k] -= static_cast<float>(along * direction[v][k]);
      }
    const double after = std::sqrt(dot(left, left));
    least = std::min(least, after / before);
    EXPECT_GT(after / before, 0.1) << mode.name;
    for (Vec3f& offset : left)
      for (float& x : offset) x = static_cast<float>(x / after);
    basis.push_back(left);
  }
  RecordProperty("least_share", std::to_string(least));
}

TEST(IdentityModes, AreMirroredWhereTheyAreSymmetric) {
  // The hair falls to one side and is left out.
  std::map<std::array<float, 3>, std::uint32_t> at;
  const std::vector<std::uint32_t> hair = part_vertices("hair");
  const std::size_t without_hair = hair.front();
  const std::vector<Vec3f>& points = head().neutral.points_mm;
  for (std::uint32_t v = 0; v < without_hair; ++v) at[points[v]] = v;
  for (const Shape& mode : modes().shapes) {
    if (is_asymmetric(mode.name)) continue;
    const std::vector<Vec3f> offsets = dense(mode);
    std::size_t wrong = 0, compared = 0;
    for (std::uint32_t v = 0; v < without_hair; ++v) {
      // Places that two vertices share (the lips' contact) may name the other one, which moves alike.
      const auto other = at.find({-points[v][0], points[v][1], points[v][2]});
      if (other == at.end()) continue;
      ++compared;
      const Vec3f &a = offsets[v], &b = offsets[other->second];
      wrong += std::abs(a[0] + b[0]) > 1e-5f || std::abs(a[1] - b[1]) > 1e-5f || std::abs(a[2] - b[2]) > 1e-5f;
    }
    EXPECT_GT(compared, without_hair * 9 / 10) << mode.name;
    EXPECT_EQ(wrong, 0u) << mode.name;
  }
}

TEST(IdentityModes, KeepTheLipsTogether) {
  for (const Shape& mode : modes().shapes) {
    const std::vector<Vec3f> offsets = dense(mode);
    for (const face::LipPair& pair : head().inner_lips)
      EXPECT_LT(distance(offsets[pair.upper], offsets[pair.lower]), 1e-5) << mode.name;
  }
}

TEST(IdentityModes, MoveTeethAsOneSolid) {
  for (const Shape& mode : modes().shapes) {
    const std::vector<Vec3f> offsets = dense(mode);
    const std::vector<std::uint32_t> teeth = part_vertices("teeth");
    for (const std::uint32_t v : teeth) EXPECT_LT(distance(offsets[v], offsets[teeth[0]]), 1e-5) << mode.name;
  }
}

TEST(IdentityModes, KeepEyeballsRound) {
  for (const Shape& mode : modes().shapes) {
    const std::vector<Vec3f> offsets = dense(mode);
    for (const char* part : {"sclera_left", "sclera_right"}) {
      // Distances between an eyeball's vertices all change by one factor.
      const std::vector<std::uint32_t> ball = part_vertices(part);
      const auto at = [&](std::size_t k) {
        const Vec3f p = head().neutral.points_mm[ball[k]], o = offsets[ball[k]];
        return Vec3f{p[0] + o[0], p[1] + o[1], p[2] + o[2]};
      };
      double low = 1e9, high = 0;
      for (std::size_t k = 40; k < ball.size(); k += 7) {
        const double factor =
            distance(at(k), at(0)) / distance(head().neutral.points_mm[ball[k]], head().neutral.points_mm[ball[0]]);
        low = std::min(low, factor);
        high = std::max(high, factor);
      }
      EXPECT_LT(high - low, 1e-4) << mode.name;
    }
  }
}

TEST(IdentityModes, FitTheBaldHeadToo) {
  face::phantom::MakeHeadOptions bald;
  bald.with_hair = false;
  const ShapeSet set = face::phantom::identity_modes(bald);
  const std::size_t vertices = face::phantom::make_head(bald).neutral.points_mm.size();
  ASSERT_EQ(set.shapes.size(), modes().shapes.size());
  for (const Shape& mode : set.shapes) EXPECT_LT(mode.vertices.back(), vertices) << mode.name;
}

}  // namespace
