// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/still_vertices.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/meshik/connected_parts.h"
#include "nodes/meshik/mesh_triangles.h"

namespace face::meshik {
namespace {

double square_apart(const Vec3f& a, const Vec3f& b) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const double apart = static_cast<double>(a[d]) - static_cast<double>(b[d]);
    sum += apart * apart;
  }
  return sum;
}

}  // namespace

VertexTargets still_vertices(const Mesh& reference, const engine::Seq<Mesh>& examples,
                             const StillVerticesOptions& options) {
  const std::vector<Vec3f>& points = reference.points_mm;
  std::vector<bool> moves(points.size(), false);
  std::size_t number = 0;
  for (const Mesh& example : examples) {
    check(example.points_mm.size() == points.size(), "example ", examples.id(number), " has ", example.points_mm.size(),
          " vertices, the reference has ", points.size());
    ++number;
    for (std::size_t v = 0; v < points.size(); ++v)
      // Not a number moves, too.
      if (!(square_apart(example.points_mm[v], points[v]) <= options.still_mm * options.still_mm)) moves[v] = true;
  }
  const std::vector<std::uint32_t> part = connected_parts(points.size(), fan_triangles(reference));
  std::vector<bool> part_moves(points.size(), false);
  for (std::size_t v = 0; v < points.size(); ++v)
    if (moves[v]) part_moves[part[v]] = true;
  std::vector<std::uint32_t> still;
  double middle[3] = {0, 0, 0};
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (moves[v] || !part_moves[part[v]]) continue;
    still.push_back(static_cast<std::uint32_t>(v));
    for (std::size_t d = 0; d < 3; ++d) middle[d] += static_cast<double>(points[v][d]);
  }
  VertexTargets result;
  if (still.empty()) return result;
  Vec3f centre;
  for (std::size_t d = 0; d < 3; ++d) centre[d] = static_cast<float>(middle[d] / static_cast<double>(still.size()));
  std::vector<double> apart;
  for (const std::uint32_t v : still) apart.push_back(square_apart(points[v], centre));
  std::vector<std::uint32_t> chosen;
  const auto count = std::min(static_cast<std::size_t>(options.count), still.size());
  while (chosen.size() < count) {
    const auto farthest = static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
    // All that is left lies upon what is chosen.
    if (!chosen.empty() && apart[farthest] <= 0) break;
    if (chosen.empty()) std::fill(apart.begin(), apart.end(), std::numeric_limits<double>::infinity());
    chosen.push_back(still[farthest]);
    for (std::size_t i = 0; i < still.size(); ++i)
      apart[i] = std::min(apart[i], square_apart(points[still[i]], points[chosen.back()]));
  }
  std::sort(chosen.begin(), chosen.end());
  for (const std::uint32_t v : chosen)
    result.targets.push_back({v, static_cast<double>(points[v][0]), static_cast<double>(points[v][1]),
                              static_cast<double>(points[v][2]), true});
  return result;
}

}  // namespace face::meshik
