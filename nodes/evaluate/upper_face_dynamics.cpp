// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/upper_face_dynamics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/regions.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {
namespace {

// Mean and variance in one pass (Welford, Note on a Method for Calculating Corrected Sums of Squares and Products,
// Technometrics 4, 1962).
struct Spread {
  double mean = 0, squares = 0, count = 0;
  void add(double value) {
    ++count;
    const double before = value - mean;
    mean += before / count;
    squares += before * (value - mean);
  }
  double deviation() const { return std::sqrt(std::max(0.0, squares / count)); }
};

}  // namespace

Table upper_face_dynamics(const Rig& rig, const engine::Seq<Weights>& weights, const engine::Seq<Weights>& truth,
                          const VertexMask* upper_face) {
  const std::vector<Vec3f>& neutral = rig.neutral.points_mm;
  const std::vector<std::uint32_t> vertices = chosen_vertices(
      upper_face, neutral.size(), "upper_face", upper_face ? std::vector<std::uint32_t>() : upper_face_vertices(rig));
  std::vector<Spread> own(vertices.size()), true_ones(vertices.size());
  for_each_pose(rig, weights, truth, [&](std::size_t, const auto& points, const auto& true_points) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::uint32_t v = vertices[i];
      own[i].add(squared_distance(points[v], neutral[v]));
      true_ones[i].add(squared_distance(true_points[v], neutral[v]));
    }
  });
  std::vector<double> own_mm2, true_mm2;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    own_mm2.push_back(own[i].deviation());
    true_mm2.push_back(true_ones[i].deviation());
  }
  const double a = mean_of(true_mm2), b = mean_of(own_mm2);
  return one_row("all", {"fdd_mm2", "truth_mm2", "own_mm2"}, {a - b, a, b});
}

}  // namespace face::evaluate
