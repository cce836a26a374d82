// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/mesh_tools.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace face::decode {

float length(const Vec3f& a) { return std::sqrt(dot(a, a)); }

float distance_to_segment(const Vec3f& p, const Vec3f& a, const Vec3f& b) {
  const Vec3f ab = minus(b, a);
  const float square = dot(ab, ab);
  const float t = square > 0 ? std::clamp(dot(minus(p, a), ab) / square, 0.0f, 1.0f) : 0.0f;
  return distance(p, {a[0] + t * ab[0], a[1] + t * ab[1], a[2] + t * ab[2]});
}

std::vector<Vec3f> vertex_normals(const Mesh& mesh) {
  std::vector<Vec3f> normals(mesh.points_mm.size());
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f) {
    const std::uint32_t first = mesh.polygon_starts[f], end = mesh.polygon_starts[f + 1];
    // Newell's normal: twice the area, for any planar or nearly planar polygon.
    Vec3f sum{};
    for (std::uint32_t i = first; i < end; ++i) {
      const Vec3f& a = mesh.points_mm[mesh.corners[i]];
      const Vec3f& b = mesh.points_mm[mesh.corners[i + 1 < end ? i + 1 : first]];
      sum[0] += (a[1] - b[1]) * (a[2] + b[2]);
      sum[1] += (a[2] - b[2]) * (a[0] + b[0]);
      sum[2] += (a[0] - b[0]) * (a[1] + b[1]);
    }
    for (std::uint32_t i = first; i < end; ++i)
      for (std::size_t k = 0; k < 3; ++k) normals[mesh.corners[i]][k] += sum[k];
  }
  for (Vec3f& n : normals)
    if (const float size = length(n); size > 0)
      for (float& x : n) x /= size;
  return normals;
}

std::vector<std::uint32_t> connected_pieces(const Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.points_mm.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f)
    for (std::uint32_t i = mesh.polygon_starts[f] + 1; i < mesh.polygon_starts[f + 1]; ++i) {
      const std::uint32_t a = root(mesh.corners[i - 1]), b = root(mesh.corners[i]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = root(v);
  return parent;
}

std::vector<bool> vertices_of_parts(const Mesh& mesh, std::string_view text) {
  std::vector<bool> inside(mesh.points_mm.size(), false);
  for (const Part& part : mesh.parts) {
    if (part.name.find(text) == std::string::npos || part.polygon_count == 0) continue;
    for (std::uint32_t i = mesh.polygon_starts[part.first_polygon];
         i < mesh.polygon_starts[part.first_polygon + part.polygon_count]; ++i)
      inside[mesh.corners[i]] = true;
  }
  return inside;
}

}  // namespace face::decode
