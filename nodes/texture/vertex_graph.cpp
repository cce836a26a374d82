// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/vertex_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace face::texture {
namespace {

constexpr float mirror_mm = 3;
constexpr int rounds = 200;
constexpr double over = 1.9;  // relaxation: fills of some fifty vertices across settle within the rounds

using Cell = std::array<int, 3>;

Cell cell_of(const Vec3f& point, float size_mm) {
  Cell cell{};
  for (std::size_t k = 0; k < 3; ++k) cell[k] = static_cast<int>(std::floor(point[k] / size_mm));
  return cell;
}

// Points by cells of a size, so that those near a place are found.
class PointGrid {
 public:
  PointGrid(const std::vector<Vec3f>& points_mm, const std::vector<bool>& among, float size_mm)
      : points_(points_mm), size_mm_(size_mm) {
    for (std::size_t v = 0; v < points_mm.size(); ++v)
      if (among[v]) cells_[cell_of(points_mm[v], size_mm)].push_back(static_cast<std::uint32_t>(v));
  }

  // Calls found(vertex, squared distance) for those within the size.
  template <class Found>
  void near(const Vec3f& place, Found found) const {
    const Cell middle = cell_of(place, size_mm_);
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const auto cell = cells_.find({middle[0] + dx, middle[1] + dy, middle[2] + dz});
          if (cell == cells_.end()) continue;
          for (const std::uint32_t v : cell->second) {
            float squares = 0;
            for (std::size_t k = 0; k < 3; ++k) squares += (points_[v][k] - place[k]) * (points_[v][k] - place[k]);
            if (squares <= size_mm_ * size_mm_) found(v, squares);
          }
        }
  }

 private:
  const std::vector<Vec3f>& points_;
  float size_mm_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;
};

}  // namespace

Neighbours vertices_within(const std::vector<Vec3f>& points_mm, const std::vector<bool>& among, float distance_mm) {
  const PointGrid grid(points_mm, among, distance_mm);
  Neighbours result;
  result.starts.push_back(0);
  for (std::size_t v = 0; v < points_mm.size(); ++v) {
    if (among[v]) grid.near(points_mm[v], [&](std::uint32_t w, float) { result.vertices.push_back(w); });
    result.starts.push_back(static_cast<std::uint32_t>(result.vertices.size()));
  }
  return result;
}

Neighbours mesh_neighbours(const Mesh& mesh, const std::vector<bool>& among) {
  std::vector<std::vector<std::uint32_t>> ends(mesh.points_mm.size());
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    if (a == b || !among[a] || !among[b]) return;
    ends[a].push_back(b);
    ends[b].push_back(a);
  };
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p)
    for (std::uint32_t c = mesh.polygon_starts[p]; c < mesh.polygon_starts[p + 1]; ++c)
      join(mesh.corners[c], mesh.corners[c + 1 < mesh.polygon_starts[p + 1] ? c + 1 : mesh.polygon_starts[p]]);
  std::map<Vec3f, std::uint32_t> first;
  for (std::size_t v = 0; v < mesh.points_mm.size(); ++v)
    if (among[v])
      join(first.try_emplace(mesh.points_mm[v], static_cast<std::uint32_t>(v)).first->second,
           static_cast<std::uint32_t>(v));
  Neighbours result;
  result.starts.push_back(0);
  for (std::vector<std::uint32_t>& list : ends) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    result.vertices.insert(result.vertices.end(), list.begin(), list.end());
    result.starts.push_back(static_cast<std::uint32_t>(result.vertices.size()));
  }
  return result;
}

std::vector<std::int32_t> mirrored_vertices(const std::vector<Vec3f>& points_mm, const std::vector<bool>& among) {
  const PointGrid grid(points_mm, among, mirror_mm);
  std::vector<std::int32_t> result(points_mm.size(), -1);
  for (std::size_t v = 0; v < points_mm.size(); ++v) {
    if (!among[v]) continue;
    float best = mirror_mm * mirror_mm;
    grid.near({-points_mm[v][0], points_mm[v][1], points_mm[v][2]}, [&](std::uint32_t w, float squares) {
      if (squares > best || (squares == best && result[v] >= 0)) return;
      best = squares;
      result[v] = static_cast<std::int32_t>(w);
    });
  }
  return result;
}

void fill_harmonically(const Neighbours& neighbours, double rest, HarmonicFill& fill) {
  for (std::size_t v = 0; v < fill.value.size(); ++v)
    if (fill.held[v] <= 0) fill.value[v] = {0, 0, 0};
  const std::vector<std::array<double, 3>> data = fill.value;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t v = 0; v < fill.value.size(); ++v) {
      const auto around = neighbours.of(v);
      const double free = 1 - fill.held[v];
      if (around.empty() || free <= 0) continue;
      const double pull = free * rest, each = free / static_cast<double>(around.size());
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = fill.held[v] * data[v][c];
        for (const std::uint32_t w : around) sum += each * fill.value[w][c];
        fill.value[v][c] += over * (sum / (fill.held[v] + free + pull) - fill.value[v][c]);
      }
    }
}

}  // namespace face::texture
