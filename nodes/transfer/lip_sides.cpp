// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/lip_sides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "nodes/base/check.h"
#include "nodes/transfer/mesh_graph.h"

namespace face::transfer {
namespace {

constexpr float head_margin_mm = 5;

struct Piece {
  std::vector<std::uint32_t> vertices;  // ascending
  double area_mm2 = 0;                  // seen from the front: positive around a surface, negative around a hole
};

// Connected pieces of the border.
std::vector<Piece> border_pieces(const Mesh& mesh) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> next;
  const auto edges = open_edges(mesh);
  for (const auto& [a, b] : edges) {
    next[a].push_back(b);
    next[b].push_back(a);
  }
  std::map<std::uint32_t, std::size_t> piece_of;
  std::vector<Piece> pieces;
  for (const auto& [start, unused] : next) {
    if (piece_of.contains(start)) continue;
    std::vector<std::uint32_t> open = {start};
    piece_of[start] = pieces.size();
    pieces.emplace_back();
    while (!open.empty()) {
      const std::uint32_t v = open.back();
      open.pop_back();
      pieces.back().vertices.push_back(v);
      for (const std::uint32_t n : next.at(v))
        if (piece_of.emplace(n, pieces.size() - 1).second) open.push_back(n);
    }
    std::sort(pieces.back().vertices.begin(), pieces.back().vertices.end());
  }
  for (const auto& [a, b] : edges) {
    const Vec3f &p = mesh.points_mm[a], &q = mesh.points_mm[b];
    pieces[piece_of.at(a)].area_mm2 += 0.5 * static_cast<double>(p[0] * q[1] - q[0] * p[1]);
  }
  return pieces;
}

// The vertices between two on the shortest way along the border's edges in their direction, ascending.
std::vector<std::uint32_t> way_along(const std::map<std::uint32_t, std::vector<std::uint32_t>>& next,
                                     std::uint32_t from, std::uint32_t to) {
  std::map<std::uint32_t, std::uint32_t> before = {{from, from}};
  std::vector<std::uint32_t> front = {from};
  while (!front.empty() && !before.contains(to)) {
    std::vector<std::uint32_t> reached;
    for (const std::uint32_t v : front)
      for (const std::uint32_t n : next.at(v))
        if (before.emplace(n, v).second) reached.push_back(n);
    front = std::move(reached);
  }
  std::vector<std::uint32_t> way;
  if (before.contains(to))
    for (std::uint32_t v = before.at(to); v != from; v = before.at(v)) way.push_back(v);
  std::sort(way.begin(), way.end());
  return way;
}

}  // namespace

MouthOpening find_mouth_opening(const Mesh& mesh, double least_width_mm) {
  const auto extent = [&](const Piece& piece) {
    const auto [low, high] = std::minmax_element(
        piece.vertices.begin(), piece.vertices.end(),
        [&](std::uint32_t a, std::uint32_t b) { return mesh.points_mm[a][0] < mesh.points_mm[b][0]; });
    return std::pair{static_cast<double>(mesh.points_mm[*low][0]), static_cast<double>(mesh.points_mm[*high][0])};
  };
  std::pair<double, double> outline = {0, 0};
  const std::vector<Piece> pieces = border_pieces(mesh);
  for (const Piece& piece : pieces)
    if (const auto [low, high] = extent(piece); high - low > outline.second - outline.first) outline = {low, high};
  const double middle = 0.5 * (outline.first + outline.second), quarter = 0.25 * (outline.second - outline.first);
  MouthOpening mouth;
  const Piece* widest = nullptr;
  double width_mm = least_width_mm;
  for (const Piece& piece : pieces) {
    const auto [low, high] = extent(piece);
    if (piece.area_mm2 >= 0 || high - low < width_mm || std::fabs(0.5 * (low + high) - middle) > quarter) continue;
    width_mm = high - low;
    widest = &piece;
  }
  if (!widest) return mouth;
  const std::vector<std::uint32_t>& piece = widest->vertices;
  std::map<std::uint32_t, std::vector<std::uint32_t>> next;
  for (const auto& [a, b] : open_edges(mesh)) next[a].push_back(b);
  const auto x_of = [&](std::uint32_t v) { return mesh.points_mm[v][0]; };
  mouth.right_corner = *std::min_element(piece.begin(), piece.end(), [&](auto a, auto b) { return x_of(a) < x_of(b); });
  mouth.left_corner = *std::max_element(piece.begin(), piece.end(), [&](auto a, auto b) { return x_of(a) < x_of(b); });
  // Edges have the surface on their left, so that the way to the left corner goes along the upper lip.
  mouth.upper = way_along(next, mouth.right_corner, mouth.left_corner);
  mouth.lower = way_along(next, mouth.left_corner, mouth.right_corner);
  return mouth;
}

std::vector<LipSide> sides_of(const Mesh& mesh, const std::vector<Vec3f>& points_mm,
                              const std::vector<std::uint32_t>& upper, const std::vector<std::uint32_t>& lower,
                              float reach_mm, float margin_mm, const std::vector<std::uint8_t>& polygons) {
  const auto neighbours = neighbours_of(mesh, polygons);
  const std::vector<float> from_upper = distances_from(neighbours, points_mm, upper, reach_mm + margin_mm),
                           from_lower = distances_from(neighbours, points_mm, lower, reach_mm + margin_mm);
  std::vector<LipSide> sides(points_mm.size(), LipSide::none);
  for (std::size_t v = 0; v < sides.size(); ++v) {
    if (from_upper[v] <= reach_mm && from_lower[v] > from_upper[v] + margin_mm) sides[v] = LipSide::upper;
    if (from_lower[v] <= reach_mm && from_upper[v] > from_lower[v] + margin_mm) sides[v] = LipSide::lower;
  }
  return sides;
}

std::vector<std::uint8_t> skin_polygons(const Mesh& mesh, const std::vector<std::uint32_t>& landmarks68) {
  std::vector<std::uint8_t> skin(mesh.polygon_count(), 0);
  const std::set<std::uint32_t> marks(landmarks68.begin(), landmarks68.end());
  bool any = false;
  for (const Part& part : mesh.parts) {
    bool holds = !marks.empty() && (part.name == "head" || part.name == "neck" || part.name == "ears");
    const std::size_t first = part.first_polygon, last = first + part.polygon_count;
    check(last <= mesh.polygon_count(), "part ", part.name, " ends at polygon ", last, ", the mesh at ",
          mesh.polygon_count());
    for (std::size_t c = mesh.polygon_starts[first]; c < mesh.polygon_starts[last]; ++c)
      holds = holds || marks.contains(mesh.corners[c]);
    for (std::size_t f = first; holds && f < last; ++f) skin[f] = 1;
    any = any || holds;
  }
  if (!any) skin.assign(skin.size(), 1);
  return skin;
}

std::vector<LipSide> head_sides(const Mesh& mesh, const std::vector<LipPair>& inner_lips,
                                const std::vector<std::uint32_t>& landmarks68, float reach_mm) {
  std::vector<std::uint32_t> upper, lower;
  for (const LipPair& pair : inner_lips) {
    upper.push_back(pair.upper);
    lower.push_back(pair.lower);
  }
  if (landmarks68.size() == 68) {  // Multi-PIE: 60 and 64 are the corners
    upper.insert(upper.end(), landmarks68.begin() + 61, landmarks68.begin() + 64);
    lower.insert(lower.end(), landmarks68.begin() + 65, landmarks68.begin() + 68);
  }
  return sides_of(mesh, mesh.points_mm, upper, lower, reach_mm, head_margin_mm, skin_polygons(mesh, landmarks68));
}

}  // namespace face::transfer
