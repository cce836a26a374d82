// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/mesh_triangles.h"

#include "nodes/base/check.h"

namespace face::meshik {

std::vector<std::uint32_t> fan_triangles(const Mesh& mesh) {
  std::vector<std::uint32_t> triangles;
  for (const std::uint32_t corner : mesh.corners)
    check(corner < mesh.points_mm.size(), "a polygon has vertex ", corner, ", expected one below ",
          mesh.points_mm.size());
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f) {
    const std::uint32_t first = mesh.polygon_starts[f], end = mesh.polygon_starts[f + 1];
    check(first <= end && end <= mesh.corners.size(), "polygon ", f, " has corners ", first, " to ", end, " of ",
          mesh.corners.size());
    for (std::uint32_t i = first + 1; i + 1 < end; ++i)
      triangles.insert(triangles.end(), {mesh.corners[first], mesh.corners[i], mesh.corners[i + 1]});
  }
  return triangles;
}

std::vector<double> coordinates(const std::vector<Vec3f>& points_mm) {
  std::vector<double> values;
  values.reserve(3 * points_mm.size());
  for (const Vec3f& point : points_mm)
    for (const float value : point) values.push_back(static_cast<double>(value));
  return values;
}

std::vector<Vec3f> points_of(const std::vector<double>& coordinates_mm) {
  std::vector<Vec3f> points(coordinates_mm.size() / 3);
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t d = 0; d < 3; ++d) points[v][d] = static_cast<float>(coordinates_mm[3 * v + d]);
  return points;
}

}  // namespace face::meshik
