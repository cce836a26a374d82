// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/prepare.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/meshik/blend_tile.h"
#include "nodes/meshik/connected_parts.h"
#include "nodes/meshik/deformation.h"
#include "nodes/meshik/factor_space.h"
#include "nodes/meshik/mesh_triangles.h"

namespace face::meshik {
namespace {

using Eigen::Vector3d;
using Points = std::vector<double>;

void check_points(const Points& points, std::size_t expected, const std::string& name) {
  check(points.size() == expected, name, " has ", points.size() / 3, " vertices, expected ", expected / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!std::isfinite(points[i]))
      fail(name, " has a coordinate of ", points[i], " at vertex ", i / 3, ", expected finite numbers");
}

Vector3d point(const Points& points, std::uint32_t v) { return {points[3 * v], points[3 * v + 1], points[3 * v + 2]}; }

std::array<Vec3d, 3> corners(const Points& points, const std::uint32_t* triangle) {
  std::array<Vec3d, 3> found;
  for (std::size_t c = 0; c < 3; ++c)
    found[c] = {points[3 * triangle[c]], points[3 * triangle[c] + 1], points[3 * triangle[c] + 2]};
  return found;
}

// Two unit vectors in the plane of a triangle and the hat functions' gradients along them.
void add_frame(const Points& reference, const std::uint32_t* triangle, std::size_t j, MeshSpace& space) {
  const Vector3d e1 = point(reference, triangle[1]) - point(reference, triangle[0]);
  const Vector3d e2 = point(reference, triangle[2]) - point(reference, triangle[0]);
  const Vector3d q1 = e1.normalized(), q2 = e1.cross(e2).cross(e1).normalized();
  const double x1 = e1.norm(), x2 = e2.dot(q1), y2 = e2.dot(q2);  // e1 = x1 q1, e2 = x2 q1 + y2 q2
  const std::size_t tile = j / tile_lanes, lane = j % tile_lanes;
  for (std::size_t d = 0; d < 3; ++d) {
    space.frames[(tile * 6 + d) * tile_lanes + lane] = q1[static_cast<Eigen::Index>(d)];
    space.frames[(tile * 6 + 3 + d) * tile_lanes + lane] = q2[static_cast<Eigen::Index>(d)];
  }
  const double g[4] = {1 / x1, -x2 / (x1 * y2), 0, 1 / y2};
  for (std::size_t c = 0; c < 4; ++c) space.gradients[(tile * 4 + c) * tile_lanes + lane] = g[c];
}

// Whether a pose changes the triangle's edges by more than rounding.
bool is_moved(const Points& reference, const Points& pose, const std::uint32_t* triangle) {
  constexpr double rounding = 1e-12;
  for (const int c : {1, 2}) {
    const Vector3d edge = point(reference, triangle[c]) - point(reference, triangle[0]);
    const Vector3d moved = point(pose, triangle[c]) - point(pose, triangle[0]);
    if ((moved - edge).norm() > rounding * edge.norm()) return true;
  }
  return false;
}

// Brings those that some example moves to the front, and returns how many these are.
std::size_t part_moving(const Points& reference, const std::vector<Points>& examples,
                        std::vector<std::uint32_t>& triangles) {
  std::vector<std::uint32_t> moving, still;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const bool moves = std::any_of(examples.begin(), examples.end(),
                                   [&](const Points& example) { return is_moved(reference, example, &triangles[i]); });
    std::vector<std::uint32_t>& side = moves ? moving : still;
    side.insert(side.end(), &triangles[i], &triangles[i] + 3);
  }
  const std::size_t count = moving.size() / 3;
  moving.insert(moving.end(), still.begin(), still.end());
  triangles = std::move(moving);
  return count;
}

void add_example(const Points& reference, const Points& example, std::size_t k, std::size_t moving, MeshSpace& space) {
  const auto examples = static_cast<std::size_t>(space.example_count);
  for (std::size_t j = 0; j < moving; ++j) {
    const std::uint32_t* triangle = &space.triangles[3 * j];
    const PolarParts parts =
        polar_parts(deformation_gradient(corners(reference, triangle), corners(example, triangle)));
    const std::size_t tile = j / tile_lanes, lane = j % tile_lanes;
    double* to = &space.blends[(tile * examples + k) * 9 * tile_lanes + lane];
    const double* q = &space.frames[tile * 6 * tile_lanes + lane];
    for (std::size_t d = 0; d < 3; ++d) {
      to[d * tile_lanes] = parts.rotation[d];
      for (std::size_t v = 0; v < 2; ++v) {
        double sum = -q[(3 * v + d) * tile_lanes];
        for (std::size_t e = 0; e < 3; ++e) sum += parts.stretch[3 * d + e] * q[(3 * v + e) * tile_lanes];
        to[(3 + 3 * v + d) * tile_lanes] = sum;
      }
    }
  }
}

void add_centroids(const Points& points, const Points* reference, const MeshSpace& space, std::size_t parts,
                   std::vector<double>& centroids) {
  const std::size_t start = centroids.size();
  centroids.resize(start + 3 * parts);
  std::vector<double> counts(parts);
  for (std::size_t v = 0; v < space.component.size(); ++v) {
    counts[space.component[v]] += 1;
    for (std::size_t d = 0; d < 3; ++d)
      centroids[start + 3 * space.component[v] + d] += points[3 * v + d] - (reference ? (*reference)[3 * v + d] : 0);
  }
  for (std::size_t i = 0; i < 3 * parts; ++i) centroids[start + i] /= counts[i / 3];
}

}  // namespace

MeshSpace prepare_triangles(const std::vector<double>& reference_mm, const std::vector<std::uint32_t>& triangles,
                            const std::vector<std::vector<double>>& examples_mm) {
  check(reference_mm.size() % 3 == 0 && triangles.size() % 3 == 0, "reference has ", reference_mm.size(),
        " coordinates and ", triangles.size(), " corners, expected three per vertex and per triangle");
  check(!reference_mm.empty(), "the reference has no vertices");
  check_points(reference_mm, reference_mm.size(), "the reference");
  for (std::size_t k = 0; k < examples_mm.size(); ++k)
    check_points(examples_mm[k], reference_mm.size(), message("example ", k));

  MeshSpace space;
  space.vertex_count = reference_mm.size() / 3;
  space.example_count = examples_mm.size();
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c)
      check(triangles[i + c] < space.vertex_count, "triangle ", i / 3, " has vertex ", triangles[i + c],
            ", expected one below ", space.vertex_count);
    const Vector3d e1 = point(reference_mm, triangles[i + 1]) - point(reference_mm, triangles[i]);
    const Vector3d e2 = point(reference_mm, triangles[i + 2]) - point(reference_mm, triangles[i]);
    // sin of the angle between the edges; below it the plane is rounding.
    constexpr double thinnest = 1e-7;
    if (e1.cross(e2).norm() > thinnest * e1.norm() * e2.norm())
      space.triangles.insert(space.triangles.end(), {triangles[i], triangles[i + 1], triangles[i + 2]});
  }
  const std::size_t tiles = tile_count(space), moving = part_moving(reference_mm, examples_mm, space.triangles);
  space.frames.assign(tiles * 6 * tile_lanes, 0.0);
  space.gradients.assign(tiles * 4 * tile_lanes, 0.0);
  space.blends.assign((moving + tile_lanes - 1) / tile_lanes * examples_mm.size() * 9 * tile_lanes, 0.0);
  for (std::size_t j = 0; j < space.triangles.size() / 3; ++j)
    add_frame(reference_mm, &space.triangles[3 * j], j, space);
  for (std::size_t k = 0; k < examples_mm.size(); ++k) add_example(reference_mm, examples_mm[k], k, moving, space);

  space.component = connected_parts(reference_mm.size() / 3, space.triangles);
  std::size_t parts = 0;
  for (const std::uint32_t part : space.component) parts = std::max<std::size_t>(parts, part + 1);
  add_centroids(reference_mm, nullptr, space, parts, space.centroids_mm);
  for (const Points& example : examples_mm) add_centroids(example, &reference_mm, space, parts, space.centroids_mm);
  factor_space(space);
  return space;
}

MeshSpace prepare(const Mesh& reference, const engine::Seq<Mesh>& examples) {
  std::vector<std::vector<double>> points;
  for (const Mesh& example : examples) points.push_back(coordinates(example.points_mm));
  return prepare_triangles(coordinates(reference.points_mm), fan_triangles(reference), points);
}

}  // namespace face::meshik
