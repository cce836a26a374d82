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

constexpr float reach_mm = 15;

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

struct Blocker {
  std::array<std::uint32_t, 3> triangle;
  Vec3f centre;
  float radius;  // of a sphere about it
};

Blocker blocker_of(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  Blocker blocker{triangle, {0, 0, 0}, 0};
  for (const std::uint32_t v : triangle)
    for (std::size_t k = 0; k < 3; ++k) blocker.centre[k] += mesh.points_mm[v][k] / 3;
  for (const std::uint32_t v : triangle)
    blocker.radius = std::max(blocker.radius, distance(mesh.points_mm[v], blocker.centre));
  return blocker;
}

std::vector<Vec3f> directions_up_and_sideways() {
  std::vector<Vec3f> directions = {{0, 1, 0}};
  for (const float up : {-0.1f, 0.3f, 0.7f})
    for (int i = 0; i < 12; ++i) {
      const float angle = static_cast<float>(i) * std::numbers::pi_v<float> / 6, flat = std::sqrt(1 - up * up);
      directions.push_back({flat * std::cos(angle), up, flat * std::sin(angle)});
    }
  return directions;
}

// Share of the directions from a vertex that lead into skin.
float blocked_share(const Mesh& mesh, std::uint32_t v, const Vec3f& normal, const std::vector<Blocker>& blockers,
                    const std::vector<Vec3f>& directions) {
  const Vec3f& origin = mesh.points_mm[v];
  std::vector<Vec3f> open;
  for (const Vec3f& direction : directions)
    if (dot(direction, normal) >= 0) open.push_back(direction);
  for (const Blocker& blocker : blockers) {
    const Vec3f to = minus(blocker.centre, origin);
    const auto& [a, b, c] = blocker.triangle;
    const float squared = dot(to, to), farthest = reach_mm + blocker.radius;
    if (squared > farthest * farthest || a == v || b == v || c == v) continue;
    std::erase_if(open, [&](const Vec3f& direction) {
      const float along = dot(to, direction);
      if (along < -blocker.radius || squared - along * along > blocker.radius * blocker.radius) return false;
      return distance_along(origin, direction, mesh.points_mm[a], mesh.points_mm[b], mesh.points_mm[c]) < reach_mm;
    });
  }
  return 1 - static_cast<float>(open.size()) / static_cast<float>(directions.size());
}

}  // namespace

std::vector<float> enclosed_by_nose(const Mesh& mesh) {
  const Vec3f& base = mesh.points_mm[ict_landmarks68[33]];
  const auto near_nostrils = [&](std::uint32_t v, float margin_mm) {
    const Vec3f off = minus(mesh.points_mm[v], base);
    return ict_face.contains(v) && std::abs(off[0]) < 16 + margin_mm && std::abs(off[1] - 5) < 13 + margin_mm &&
           std::abs(off[2]) < 18 + margin_mm;
  };
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Blocker> blockers;
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f)
    for (std::uint32_t c = mesh.polygon_starts[f] + 2; c < mesh.polygon_starts[f + 1]; ++c) {
      const std::array<std::uint32_t, 3> triangle = {mesh.corners[mesh.polygon_starts[f]], mesh.corners[c - 1],
                                                     mesh.corners[c]};
      if (!near_nostrils(triangle[0], reach_mm)) continue;
      triangles.push_back(triangle);
      blockers.push_back(blocker_of(mesh, triangle));
    }
  const std::vector<Vec3f> directions = directions_up_and_sideways(), normals = vertex_normals(mesh);
  std::vector<float> enclosed(mesh.points_mm.size(), 0.0f);
  for (std::uint32_t v = ict_face.first; v <= ict_face.last; ++v)
    if (near_nostrils(v, 0)) enclosed[v] = blocked_share(mesh, v, normals[v], blockers, directions);
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
