// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/mesh_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "nodes/base/check.h"

namespace face::transfer {
namespace {

template <class Visit>
void each_edge(const Mesh& mesh, const std::vector<std::uint8_t>& polygons, Visit visit) {
  for (std::size_t f = 0; f < mesh.polygon_count(); ++f) {
    if (!polygons.empty() && !polygons[f]) continue;
    const std::uint32_t first = mesh.polygon_starts[f], last = mesh.polygon_starts[f + 1];
    for (std::uint32_t c = first; c < last; ++c) {
      const std::uint32_t a = mesh.corners[c], b = mesh.corners[c + 1 == last ? first : c + 1];
      check(a < mesh.points_mm.size() && b < mesh.points_mm.size(), "polygon ", f, " has vertex ", std::max(a, b),
            ", the mesh ends at ", mesh.points_mm.size());
      if (a != b) visit(a, b);
    }
  }
}

}  // namespace

std::vector<std::vector<std::uint32_t>> neighbours_of(const Mesh& mesh, const std::vector<std::uint8_t>& polygons) {
  std::vector<std::vector<std::uint32_t>> out(mesh.points_mm.size());
  each_edge(mesh, polygons, [&](std::uint32_t a, std::uint32_t b) {
    out[a].push_back(b);
    out[b].push_back(a);
  });
  for (auto& list : out) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return out;
}

std::vector<float> distances_from(const std::vector<std::vector<std::uint32_t>>& neighbours,
                                  const std::vector<Vec3f>& points_mm, const std::vector<std::uint32_t>& seeds,
                                  float reach_mm) {
  std::vector<float> distance(neighbours.size(), std::numeric_limits<float>::infinity());
  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (const std::uint32_t s : seeds) {
    check(s < neighbours.size(), "there is no vertex ", s, ", the mesh has ", neighbours.size());
    distance[s] = 0;
    open.push({0, s});
  }
  while (!open.empty()) {
    const auto [d, v] = open.top();
    open.pop();
    if (d > distance[v]) continue;
    for (const std::uint32_t n : neighbours[v]) {
      const Vec3f &p = points_mm[v], &q = points_mm[n];
      const float to = d + std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      if (to > reach_mm || !(to < distance[n])) continue;
      distance[n] = to;
      open.push({to, n});
    }
  }
  return distance;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> open_edges(const Mesh& mesh) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<std::pair<Edge, Edge>> edges;  // ascending, and as the polygon has it
  each_edge(mesh, {}, [&](std::uint32_t a, std::uint32_t b) {
    edges.push_back({{std::min(a, b), std::max(a, b)}, {a, b}});
  });
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> out;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end].first == edges[i].first) ++end;
    if (end == i + 1) out.push_back(edges[i].second);
    i = end;
  }
  return out;
}

void spread_known(const std::vector<std::vector<std::uint32_t>>& neighbours, const std::vector<std::uint8_t>& known,
                  std::vector<Vec3f>& values) {
  const std::size_t count = neighbours.size();
  std::array<double, 3> sum = {0, 0, 0};
  double total = 0;
  for (std::size_t v = 0; v < count; ++v)
    if (known[v]) {
      for (std::size_t k = 0; k < 3; ++k) sum[k] += static_cast<double>(values[v][k]);
      ++total;
    }
  if (total == 0) return;
  // Ring by ring: the mean of the neighbours that are reached already.
  std::vector<std::uint8_t> reached = known;
  std::vector<std::uint32_t> ring, unknown;
  for (std::uint32_t v = 0; v < count; ++v)
    if (known[v]) ring.push_back(v);
  while (!ring.empty()) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t v : ring)
      for (const std::uint32_t n : neighbours[v])
        if (!reached[n]) {
          reached[n] = 2;
          next.push_back(n);
        }
    for (const std::uint32_t v : next) {
      Vec3f mean = {0, 0, 0};
      float parts = 0;
      for (const std::uint32_t n : neighbours[v])
        if (reached[n] == 1) {
          for (std::size_t k = 0; k < 3; ++k) mean[k] += values[n][k];
          ++parts;
        }
      for (float& x : mean) x /= parts;
      values[v] = mean;
    }
    for (const std::uint32_t v : next) reached[v] = 1;
    unknown.insert(unknown.end(), next.begin(), next.end());
    ring = std::move(next);
  }
  for (std::size_t v = 0; v < count; ++v)
    if (!reached[v])
      for (std::size_t k = 0; k < 3; ++k) values[v][k] = static_cast<float>(sum[k] / total);
  for (int sweep = 0; sweep < 60; ++sweep)
    for (const std::uint32_t v : unknown) {
      Vec3f mean = {0, 0, 0};
      for (const std::uint32_t n : neighbours[v])
        for (std::size_t k = 0; k < 3; ++k) mean[k] += values[n][k];
      for (std::size_t k = 0; k < 3; ++k) values[v][k] = mean[k] / static_cast<float>(neighbours[v].size());
    }
}

}  // namespace face::transfer
