// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/connected_parts.h"

#include <algorithm>
#include <numeric>

namespace face::meshik {

std::vector<std::uint32_t> connected_parts(std::size_t vertex_count, const std::vector<std::uint32_t>& triangles) {
  // Every vertex points at one with a smaller number of its part, the first at itself.
  std::vector<std::uint32_t> parent(vertex_count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t i = 0; i < triangles.size(); i += 3)
    for (std::size_t c = 1; c < 3; ++c) {
      const std::uint32_t a = root(triangles[i]), b = root(triangles[i + c]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::uint32_t> part(vertex_count);
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < vertex_count; ++v) part[v] = parent[v] == v ? count++ : part[root(v)];
  return part;
}

}  // namespace face::meshik
