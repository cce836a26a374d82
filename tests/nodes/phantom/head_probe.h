// SPDX-License-Identifier: Apache-2.0
// What the tests of the embedded head measure on it.
#pragma once
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/phantom/make_head.h"
#include "nodes/types/arkit.h"
#include "nodes/types/rig.h"

namespace probe {

// The head under test, made once.
inline const face::Rig& head() {
  static const face::Rig rig = face::phantom::make_head();
  return rig;
}

// Weights of shapes by their ARKit names.
using Pose = std::initializer_list<std::pair<std::string_view, float>>;

inline std::vector<face::Vec3f> posed(Pose pose) {
  face::Weights weights;
  weights.values.assign(head().shapes.size(), 0.0f);
  for (const auto& [name, weight] : pose) {
    const std::size_t shape = face::arkit_index(name);
    face::check(shape < face::arkit_count, "no shape is called '", name, "'");
    weights.values[shape] = weight;
  }
  return face::pose_points(head(), weights);
}

inline double distance(const face::Vec3f& a, const face::Vec3f& b) {
  return std::hypot(double{a[0]} - b[0], double{a[1]} - b[1], double{a[2]} - b[2]);
}

// Ascending.
inline std::vector<std::uint32_t> part_vertices(std::string_view name) {
  const face::Mesh& mesh = head().neutral;
  std::vector<std::uint32_t> vertices;
  for (const face::Part& part : mesh.parts)
    if (part.name == name)
      vertices.assign(mesh.corners.begin() + mesh.polygon_starts[part.first_polygon],
                      mesh.corners.begin() + mesh.polygon_starts[part.first_polygon + part.polygon_count]);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

inline std::string part_of(std::size_t polygon) {
  for (const face::Part& part : head().neutral.parts)
    if (polygon >= part.first_polygon && polygon < part.first_polygon + part.polygon_count) return part.name;
  return "no part";
}

// Volume below a part's polygons as seen from the part's centroid, mm^3.
inline double signed_volume(std::string_view name) {
  const face::Mesh& mesh = head().neutral;
  double centre[3] = {0, 0, 0}, volume = 0;
  const std::vector<std::uint32_t> vertices = part_vertices(name);
  for (const std::uint32_t v : vertices)
    for (std::size_t k = 0; k < 3; ++k) centre[k] += mesh.points_mm[v][k] / static_cast<double>(vertices.size());
  for (const face::Part& part : mesh.parts) {
    if (part.name != name) continue;
    for (std::uint32_t f = part.first_polygon; f < part.first_polygon + part.polygon_count; ++f)
      for (std::uint32_t i = mesh.polygon_starts[f] + 1; i + 1 < mesh.polygon_starts[f + 1]; ++i) {
        double p[3][3];
        const std::uint32_t corner[3] = {mesh.corners[mesh.polygon_starts[f]], mesh.corners[i], mesh.corners[i + 1]};
        for (int j = 0; j < 3; ++j)
          for (std::size_t k = 0; k < 3; ++k) p[j][k] = mesh.points_mm[corner[j]][k] - centre[k];
        volume +=
            (p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) + p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
             p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0])) /
            6;
      }
  }
  return volume;
}

// Vertical distances between the lips at the inner pairs.
inline std::vector<double> lip_gaps(const std::vector<face::Vec3f>& points) {
  std::vector<double> gaps;
  for (const face::LipPair& pair : head().inner_lips) gaps.push_back(points[pair.upper][1] - points[pair.lower][1]);
  return gaps;
}

inline double widest_lip_gap(const std::vector<face::Vec3f>& points) {
  const std::vector<double> gaps = lip_gaps(points);
  return *std::max_element(gaps.begin(), gaps.end());
}

inline double narrowest_lip_gap(const std::vector<face::Vec3f>& points) {
  const std::vector<double> gaps = lip_gaps(points);
  return *std::min_element(gaps.begin(), gaps.end());
}

// Smallest distance of the lower lip's vertices to those of the upper front teeth.
inline double lip_to_teeth(const std::vector<face::Vec3f>& points) {
  double nearest = 1e9;
  for (const std::uint32_t lip : head().lower_lip)
    for (const std::uint32_t tooth : head().upper_teeth)
      nearest = std::min(nearest, distance(points[lip], points[tooth]));
  return nearest;
}

}  // namespace probe
