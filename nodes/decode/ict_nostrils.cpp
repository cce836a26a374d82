// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/ict_nostrils.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "nodes/decode/ict_layout.h"
#include "nodes/decode/mesh_tools.h"

namespace face::decode {
namespace {

Vec3f cross(const Vec3f& a, const Vec3f& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Distance along a ray of unit direction to a triangle, seen from either side; a large one where it is missed
// (Moeller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997).
float distance_along(const Vec3f& origin, const Vec3f& direction, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  constexpr float missed = 1e9f;
  const Vec3f e = minus(b, a), f = minus(c, a), from_a = minus(origin, a);
  const Vec3f p = cross(direction, f), q = cross(from_a, e);
  const float determinant = dot(e, p);
  if (std::abs(determinant) < 1e-9f) return missed;
  const float u = dot(from_a, p) / determinant, v = dot(direction, q) / determinant;
  const float along = dot(f, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && along > 0 ? along : missed;
}

}  // namespace

std::vector<float> enclosed_by_nose(const Mesh& mesh) {
  constexpr float reach_mm = 15;
  const Vec3f& base = mesh.points_mm[ict_landmarks68[33]];
  const auto near_nostrils = [&](std::uint32_t v, float margin_mm) {
    const Vec3f off = minus(mesh.points_mm[v], base);
    return ict_face.contains(v) && std::abs(off[0]) < 18 + margin_mm && std::abs(off[1] - 5) < 13 + margin_mm &&
           std::abs(off[2]) < 18 + margin_mm;
  };
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f)
    for (std::uint32_t c = mesh.polygon_starts[f] + 2; c < mesh.polygon_starts[f + 1]; ++c) {
      const std::array<std::uint32_t, 3> triangle = {mesh.corners[mesh.polygon_starts[f]], mesh.corners[c - 1],
                                                     mesh.corners[c]};
      if (near_nostrils(triangle[0], reach_mm)) triangles.push_back(triangle);
    }
  std::vector<Vec3f> directions = {{0, 1, 0}};
  for (const float up : {-0.1f, 0.3f, 0.7f})
    for (int i = 0; i < 12; ++i) {
      const float angle = static_cast<float>(i) * std::numbers::pi_v<float> / 6, flat = std::sqrt(1 - up * up);
      directions.push_back({flat * std::cos(angle), up, flat * std::sin(angle)});
    }
  const std::vector<Vec3f> normals = vertex_normals(mesh);
  std::vector<float> enclosed(mesh.points_mm.size(), 0.0f);  // share of the directions
  for (std::uint32_t v = ict_face.first; v <= ict_face.last; ++v) {
    if (!near_nostrils(v, 0)) continue;
    const auto blocked = std::count_if(directions.begin(), directions.end(), [&](const Vec3f& direction) {
      if (dot(direction, normals[v]) < 0) return true;
      return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
        return t[0] != v && t[1] != v && t[2] != v &&
               distance_along(mesh.points_mm[v], direction, mesh.points_mm[t[0]], mesh.points_mm[t[1]],
                              mesh.points_mm[t[2]]) < reach_mm;
      });
    });
    enclosed[v] = static_cast<float>(blocked) / static_cast<float>(directions.size());
  }
  for (int pass = 0; pass < 2; ++pass) {  // few rays: means over neighbours hide their noise
    std::vector<float> sum(enclosed.size(), 0.0f), count(enclosed.size(), 0.0f);
    for (const auto& t : triangles)
      for (const std::uint32_t v : t) {
        sum[v] += enclosed[t[0]] + enclosed[t[1]] + enclosed[t[2]];
        count[v] += 3;
      }
    for (std::uint32_t v = ict_face.first; v <= ict_face.last; ++v)
      if (near_nostrils(v, 0) && count[v] > 0) enclosed[v] = sum[v] / count[v];
  }
  return enclosed;
}

}  // namespace face::decode
