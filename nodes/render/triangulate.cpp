// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/triangulate.h"

#include <cmath>

#include "nodes/base/check.h"

namespace face::render {

Triangulation triangulate(const Mesh& mesh, bool visible_only) {
  const std::size_t polygon_count = mesh.polygon_count();
  std::vector<std::uint16_t> part_of_polygon(polygon_count, 0);
  std::vector<bool> drawn(polygon_count, true);
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    const Part& part = mesh.parts[p];
    check(static_cast<std::size_t>(part.first_polygon) + part.polygon_count <= polygon_count, "part \"", part.name,
          "\" ends at polygon ", static_cast<std::size_t>(part.first_polygon) + part.polygon_count,
          ", but the mesh has ", polygon_count);
    for (std::uint32_t i = 0; i < part.polygon_count; ++i) {
      part_of_polygon[part.first_polygon + i] = static_cast<std::uint16_t>(p);
      if (visible_only && !part.visible) drawn[part.first_polygon + i] = false;
    }
  }
  Triangulation result;
  result.triangles.reserve(mesh.corners.size());
  result.polygons.reserve(mesh.corners.size());
  result.parts.reserve(mesh.corners.size());
  for (std::size_t f = 0; f < polygon_count; ++f) {
    if (!drawn[f]) continue;
    const std::uint32_t start = mesh.polygon_starts[f];
    const std::uint32_t end = mesh.polygon_starts[f + 1];
    check(start <= end && end <= mesh.corners.size(), "polygon ", f, " has corners ", start, " to ", end,
          ", but the mesh has ", mesh.corners.size());
    for (std::uint32_t c = start + 2; c < end; ++c) {
      result.triangles.push_back({mesh.corners[start], mesh.corners[c - 1], mesh.corners[c]});
      result.polygons.push_back(static_cast<std::uint32_t>(f));
      result.parts.push_back(part_of_polygon[f]);
    }
  }
  return result;
}

std::vector<Vec3f> vertex_normals(const std::vector<Vec3f>& points_mm, const std::vector<Triangle>& triangles) {
  std::vector<Vec3f> normals(points_mm.size(), Vec3f{0, 0, 0});
  for (const Triangle& t : triangles) {
    const Vec3f& a = points_mm[t[0]];
    const Vec3f& b = points_mm[t[1]];
    const Vec3f& c = points_mm[t[2]];
    const float ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const float vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    for (const std::uint32_t vertex : t) {
      normals[vertex][0] += nx;
      normals[vertex][1] += ny;
      normals[vertex][2] += nz;
    }
  }
  for (Vec3f& n : normals) {
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const float inverse = length > 0 ? 1.0f / length : 0.0f;
    for (float& axis : n) axis *= inverse;
  }
  return normals;
}

}  // namespace face::render
