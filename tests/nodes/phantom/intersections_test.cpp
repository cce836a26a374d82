// SPDX-License-Identifier: Apache-2.0
// Lips, teeth, lids and eyeballs of the embedded head never pass through each other, at rest and at each shape's
// weight 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "nodes/base/pose.h"
#include "nodes/phantom/eyelids.h"
#include "nodes/phantom/lips.h"
#include "nodes/phantom/skin_layout.h"
#include "nodes/types/arkit.h"
#include "tests/nodes/phantom/head_probe.h"

namespace {

using face::Vec3f;
using namespace face::phantom;
using namespace probe;
using Points = std::vector<Vec3f>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// The layout numbers the skin's vertices first, so these numbers hold on the head.
const Skin& layout() {
  static const Skin skin = [] {
    HeadBuilder builder;
    return add_skin(builder);
  }();
  return skin;
}

// One lip's surface from the border of the red to the lining behind it. side: 1 upper, -1 lower.
Triangles lip_surface(int side) {
  Triangles triangles;
  for (int ring = -7; ring < 0; ++ring)
    for (int c = 0; c < kMouthColumns; ++c) {
      const int d = (c + 1) % kMouthColumns;
      if (lip_side(c) == -side || lip_side(d) == -side) continue;
      const std::uint32_t p[4] = {layout().mouth(ring, c), layout().mouth(ring + 1, c), layout().mouth(ring + 1, d),
                                  layout().mouth(ring, d)};
      triangles.push_back({p[0], p[1], p[2]});
      triangles.push_back({p[0], p[2], p[3]});
    }
  return triangles;
}

std::vector<std::uint32_t> lip_vertices(int side) {
  std::vector<std::uint32_t> vertices;
  for (int ring = -6; ring <= 0; ++ring)
    for (int c = 0; c < kMouthColumns; ++c)
      if (lip_side(c) == side) vertices.push_back(layout().mouth(ring, c));
  return vertices;
}

Triangles part_triangles(std::string_view name, double low_y, double high_y) {
  const face::Mesh& mesh = head().neutral;
  Triangles triangles;
  for (const face::Part& part : mesh.parts) {
    if (part.name != name) continue;
    for (std::uint32_t f = part.first_polygon; f < part.first_polygon + part.polygon_count; ++f)
      for (std::uint32_t i = mesh.polygon_starts[f] + 1; i + 1 < mesh.polygon_starts[f + 1]; ++i) {
        const std::uint32_t a = mesh.corners[mesh.polygon_starts[f]];
        if (mesh.points_mm[a][1] > low_y && mesh.points_mm[a][1] < high_y)
          triangles.push_back({a, mesh.corners[i], mesh.corners[i + 1]});
      }
  }
  return triangles;
}

// Height of a triangle over the place (x, z), if it covers it and faces down (or up).
bool height_at(const Points& points, const std::array<std::uint32_t, 3>& t, double x, double z, bool facing_down,
               double& y) {
  const Vec3f &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
  const double abx = double{b[0]} - a[0], abz = double{b[2]} - a[2], acx = double{c[0]} - a[0],
               acz = double{c[2]} - a[2];
  const double area = abz * acx - abx * acz;  // twice the area seen from above; positive where the triangle faces up
  if (std::abs(area) < 1e-6 || (area < 0) != facing_down) return false;
  const double px = x - a[0], pz = z - a[2];
  const double u = (pz * acx - px * acz) / area, v = (abz * px - abx * pz) / area;
  if (u < 0 || v < 0 || u + v > 1) return false;
  y = a[1] + u * (double{b[1]} - a[1]) + v * (double{c[1]} - a[1]);
  return true;
}

// How deep the vertices of what lies below stick into the underside of what lies above, mm.
double depth_into_underside(const Points& points, const std::vector<std::uint32_t>& below, const Triangles& above) {
  double deepest = 0;
  for (const std::uint32_t v : below)
    for (const auto& triangle : above) {
      double y = 0;
      if (height_at(points, triangle, points[v][0], points[v][2], true, y))
        deepest = std::max(deepest, points[v][1] - y);
    }
  return deepest;
}

double depth_into_top(const Points& points, const std::vector<std::uint32_t>& above, const Triangles& below) {
  double deepest = 0;
  for (const std::uint32_t v : above)
    for (const auto& triangle : below) {
      double y = 0;
      if (height_at(points, triangle, points[v][0], points[v][2], false, y))
        deepest = std::max(deepest, y - points[v][1]);
    }
  return deepest;
}

double lip_crossing(const Points& points) {
  static const Triangles upper = lip_surface(1), lower = lip_surface(-1);
  static const std::vector<std::uint32_t> upper_vertices = lip_vertices(1), lower_vertices = lip_vertices(-1);
  return std::max(depth_into_underside(points, lower_vertices, upper), depth_into_top(points, upper_vertices, lower));
}

// How far a tooth stands out of the lips: the longest way from one of its vertices back towards the middle of the mouth
// to a lip's surface. 0 where all teeth are inside.
double teeth_through_lips(const Points& points) {
  static const std::vector<std::uint32_t> teeth = part_vertices("teeth");
  static const Triangles lips = [] {
    Triangles both = lip_surface(1);
    const Triangles lower = lip_surface(-1);
    both.insert(both.end(), lower.begin(), lower.end());
    return both;
  }();
  double worst = 0;
  for (const std::uint32_t v : teeth) {
    const Vec3f& o = points[v];
    if (o[2] < 84) continue;  // back teeth lie behind the lips' corners
    const double dir[3] = {-double{o[0]}, 0, 60.0 - o[2]};
    const double norm = std::hypot(dir[0], dir[2]);
    for (const auto& t : lips) {
      // Moeller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, JGT 1997.
      double e1[3], e2[3], s[3];
      for (std::size_t k = 0; k < 3; ++k) {
        e1[k] = double{points[t[1]][k]} - points[t[0]][k];
        e2[k] = double{points[t[2]][k]} - points[t[0]][k];
        s[k] = double{o[k]} - points[t[0]][k];
      }
      const double h[3] = {dir[1] * e2[2] - dir[2] * e2[1], dir[2] * e2[0] - dir[0] * e2[2],
                           dir[0] * e2[1] - dir[1] * e2[0]};
      const double det = e1[0] * h[0] + e1[1] * h[1] + e1[2] * h[2];
      if (std::abs(det) < 1e-9) continue;
      const double u = (s[0] * h[0] + s[1] * h[1] + s[2] * h[2]) / det;
      const double q[3] = {s[1] * e1[2] - s[2] * e1[1], s[2] * e1[0] - s[0] * e1[2], s[0] * e1[1] - s[1] * e1[0]};
      const double w = (dir[0] * q[0] + dir[1] * q[1] + dir[2] * q[2]) / det;
      const double along = (e2[0] * q[0] + e2[1] * q[1] + e2[2] * q[2]) / det;
      if (u >= 0 && w >= 0 && u + w <= 1 && along > 0 && along * norm < 20) worst = std::max(worst, along * norm);
    }
  }
  return worst;
}

double teeth_crossing(const Points& points) {
  static const double edge_y = -36.5;  // between the rows
  static const Triangles upper = part_triangles("teeth", edge_y, 100), lower = part_triangles("teeth", -100, edge_y);
  std::vector<std::uint32_t> upper_vertices, lower_vertices;
  for (const std::uint32_t v : part_vertices("teeth"))
    (head().neutral.points_mm[v][1] > edge_y ? upper_vertices : lower_vertices).push_back(v);
  return std::max(depth_into_underside(points, lower_vertices, upper), depth_into_top(points, upper_vertices, lower));
}

// Smallest distance of the left lids, front edge and skin, from the eyeball; negative inside it. Vertices and polygon
// middles.
double lid_clearance(const Points& points) {
  double smallest = 1e9;
  const auto from_ball = [&](std::initializer_list<std::uint32_t> vertices) {
    double p[3] = {-kEyeCentre.x, -kEyeCentre.y, -kEyeCentre.z};
    for (const std::uint32_t v : vertices)
      for (std::size_t k = 0; k < 3; ++k) p[k] += points[v][k] / static_cast<double>(vertices.size());
    return std::hypot(p[0], p[1], p[2]) - kEyeRadius;
  };
  for (int ring = -1; ring < kEyeOuterRing; ++ring)
    for (int c = 0; c < kEyeColumns; ++c) {
      const int d = (c + 1) % kEyeColumns;
      smallest = std::min(smallest, from_ball({layout().left_eye(ring, c)}));
      smallest = std::min(smallest, from_ball({layout().left_eye(ring, c), layout().left_eye(ring, d),
                                               layout().left_eye(ring + 1, c), layout().left_eye(ring + 1, d)}));
    }
  return smallest;
}

constexpr double kTouching_mm = 0.3;  // lips are soft and drawn as polygons

TEST(HeadIntersections, AreFoundByTheseChecks) {
  Points points = head().neutral.points_mm;
  for (const std::uint32_t v : lip_vertices(-1)) points[v][1] += 2;
  EXPECT_GT(lip_crossing(points), 1.0);
  points = head().neutral.points_mm;
  for (const std::uint32_t v : part_vertices("teeth")) points[v][2] += 14;
  EXPECT_GT(teeth_through_lips(points), 1.0);
  points = head().neutral.points_mm;
  for (const std::uint32_t v : part_vertices("teeth"))
    if (points[v][1] < -36.5f) points[v] = {points[v][0], points[v][1] + 3, points[v][2] + 1.5f};
  EXPECT_GT(teeth_crossing(points), 1.0);
  points = head().neutral.points_mm;
  points[layout().left_eye(0, 12)][2] -= 3;
  EXPECT_LT(lid_clearance(points), -0.5);
}

TEST(HeadIntersections, AreAbsentAtRest) {
  const Points& points = head().neutral.points_mm;
  EXPECT_LE(lip_crossing(points), 0.02);
  EXPECT_EQ(teeth_through_lips(points), 0);
  EXPECT_EQ(teeth_crossing(points), 0);
  EXPECT_GT(lid_clearance(points), 0.2);
}

TEST(HeadIntersections, AreAbsentAtEachShapesFullWeight) {
  for (const std::string_view name : face::arkit_names) {
    if (name == "mouthClose") continue;  // a corrective of jawOpen, below
    const Points points = posed({{name, 1.0f}});
    EXPECT_LE(lip_crossing(points), kTouching_mm) << name;
    EXPECT_EQ(teeth_through_lips(points), 0) << name;
    EXPECT_EQ(teeth_crossing(points), 0) << name;
    EXPECT_GT(lid_clearance(points), 0) << name;
  }
}

TEST(HeadIntersections, AreAbsentInClosedMouthsOnAnyJaw) {
  for (const float w : {0.1f, 0.15f, 0.3f, 0.5f, 1.0f}) {
    const Points points = posed({{"jawOpen", w}, {"mouthClose", w}});
    EXPECT_LE(lip_crossing(points), kTouching_mm) << w;
    EXPECT_EQ(teeth_through_lips(points), 0) << w;
  }
}

TEST(HeadIntersections, AreAbsentInTheMouthsOfSpeech) {
  const auto expect_clean = [](const char* sound, Pose pose) {
    const Points points = posed(pose);
    EXPECT_LE(lip_crossing(points), kTouching_mm) << sound;
    EXPECT_EQ(teeth_through_lips(points), 0) << sound;
    EXPECT_EQ(teeth_crossing(points), 0) << sound;
  };
  expect_clean("B", {{"jawOpen", 0.15f},
                     {"mouthClose", 0.15f},
                     {"mouthRollLower", 0.4f},
                     {"mouthRollUpper", 0.4f},
                     {"mouthPressLeft", 0.3f},
                     {"mouthPressRight", 0.3f}});
  expect_clean("F", {{"mouthRollLower", 0.9f}, {"mouthUpperUpLeft", 0.4f}, {"mouthUpperUpRight", 0.4f}});
  expect_clean("U", {{"jawOpen", 0.08f}, {"mouthFunnel", 0.4f}, {"mouthPucker", 0.6f}});
  expect_clean("EE", {{"jawOpen", 0.1f},
                      {"mouthSmileLeft", 0.5f},
                      {"mouthSmileRight", 0.5f},
                      {"mouthStretchLeft", 0.3f},
                      {"mouthStretchRight", 0.3f}});
  expect_clean("AA", {{"jawOpen", 0.6f}, {"mouthLowerDownLeft", 0.3f}, {"mouthLowerDownRight", 0.3f}});
}

// Quads of the face whose two triangles face away from each other.
std::size_t folded_quads(const Points& points) {
  const face::Mesh& mesh = head().neutral;
  const auto normal = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto at = [&](std::uint32_t k) {
      const Vec3f& p = points[mesh.corners[k]];
      return Vector3{p[0], p[1], p[2]};
    };
    return unit(cross(at(b) - at(a), at(c) - at(a)));
  };
  std::size_t count = 0;
  for (const face::Part& part : mesh.parts) {
    if (part.name != "face") continue;
    for (std::uint32_t f = part.first_polygon; f < part.first_polygon + part.polygon_count; ++f) {
      const std::uint32_t a = mesh.polygon_starts[f];
      if (mesh.polygon_starts[f + 1] - a != 4) continue;
      count += dot(normal(a, a + 1, a + 2), normal(a, a + 2, a + 3)) < -0.2 ||
               dot(normal(a, a + 1, a + 3), normal(a + 1, a + 2, a + 3)) < -0.2;
    }
  }
  return count;
}

TEST(HeadIntersections, DoNotComeFromFoldedSkin) {
  EXPECT_EQ(folded_quads(head().neutral.points_mm), 0u);
  // In the corners of eyes and mouth a few small quads fold, as skin does.
  for (const std::string_view name : face::arkit_names) EXPECT_LE(folded_quads(posed({{name, 1.0f}})), 6u) << name;
}

TEST(HeadIntersections, AreAbsentOnTheWayToABlink) {
  // Lids move on straight lines past a round eye; their edge may lose half of its clearance, but never dip into the
  // eye.
  for (const char* name : {"eyeBlinkLeft", "eyeLookDownLeft", "eyeSquintLeft"})
    for (const float w : {0.25f, 0.5f, 0.75f})
      EXPECT_GT(lid_clearance(posed({{name, w}})), -0.6) << name << " at " << w;
}

}  // namespace
