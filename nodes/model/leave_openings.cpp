// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/leave_openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/scan_points.h"

namespace face::model {
namespace {

// How far from the border a vertex is looked at from: at a stride of 2 pixels lips' edges have been seen 6 pixels off,
// and up to 20 where a jaw falls so fast that the scanner loses the lip.
constexpr std::array<int, 3> depths = {4, 8, 12};
constexpr double step_px = 0.25;

std::size_t index(const DepthScan& scan, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(scan.picture.width) + static_cast<std::size_t>(x);
}

// 1 where nothing is measured and the way to the picture's border is barred by what is.
std::vector<std::uint8_t> openings_of(const DepthScan& scan) {
  const int width = scan.picture.width, height = scan.picture.height;
  std::vector<std::uint8_t> open;
  open.reserve(scan.depth_mm.size());
  for (const float depth : scan.depth_mm) open.push_back(depth > 0 ? 0 : 1);
  std::vector<std::array<int, 2>> outside;
  const auto leave = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= width || y >= height || open[index(scan, x, y)] == 0) return;
    open[index(scan, x, y)] = 0;
    outside.push_back({x, y});
  };
  for (int x = 0; x < width; ++x) leave(x, 0), leave(x, height - 1);
  for (int y = 0; y < height; ++y) leave(0, y), leave(width - 1, y);
  while (!outside.empty()) {
    const auto [x, y] = outside.back();
    outside.pop_back();
    leave(x - 1, y), leave(x + 1, y), leave(x, y - 1), leave(x, y + 1);
  }
  return open;
}

// Every vertex's neighbours along the edges, and whether it is on the mesh's border.
struct Edges {
  std::vector<std::vector<std::uint32_t>> to;
  std::vector<std::uint8_t> border;
};

Edges edges_of(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p)
    for (std::uint32_t first = mesh.polygon_starts[p], last = mesh.polygon_starts[p + 1], k = first; k < last; ++k)
      all.push_back(std::minmax(mesh.corners[k], mesh.corners[k + 1 < last ? k + 1 : first]));
  std::sort(all.begin(), all.end());
  Edges edges{std::vector<std::vector<std::uint32_t>>(mesh.points_mm.size()),
              std::vector<std::uint8_t>(mesh.points_mm.size(), 0)};
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && all[i] == all[i - 1]) continue;
    const auto [a, b] = all[i];
    edges.to[a].push_back(b);
    edges.to[b].push_back(a);
    if (i + 1 == all.size() || all[i + 1] != all[i]) edges.border[a] = edges.border[b] = 1;
  }
  return edges;
}

// Spreads from the vertices of a front to those that have no number yet, ring by ring; give(from, to) numbers them.
template <class Give>
void spread(const Edges& edges, std::vector<std::uint32_t> front, int most, Give give) {
  for (int ring = 0; ring < most && !front.empty(); ++ring) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t from : front)
      for (const std::uint32_t to : edges.to[from])
        if (give(from, to)) next.push_back(to);
    front = std::move(next);
  }
}

// Of every vertex that is nearer to the border the nearest that is `rings` away from it; -1 for the others.
std::vector<std::int64_t> anchors_of(const Edges& edges, int rings) {
  std::vector<int> away(edges.to.size(), rings);
  std::vector<std::uint32_t> border, deep;
  for (std::uint32_t v = 0; v < away.size(); ++v)
    if (edges.border[v]) {
      away[v] = 0;
      border.push_back(v);
    }
  spread(edges, border, rings - 1, [&](std::uint32_t from, std::uint32_t to) {
    if (away[to] <= away[from] + 1) return false;
    away[to] = away[from] + 1;
    return true;
  });
  std::vector<std::int64_t> anchor(away.size(), -1);
  for (std::uint32_t v = 0; v < away.size(); ++v)
    if (away[v] == rings) deep.push_back(v);
  spread(edges, deep, 2 * rings, [&](std::uint32_t from, std::uint32_t to) {
    if (away[to] == rings || anchor[to] >= 0) return false;
    anchor[to] = away[from] == rings ? static_cast<std::int64_t>(from) : anchor[from];
    return true;
  });
  return anchor;
}

}  // namespace

MeshPoints leave_openings(const Mesh& mesh, const MeshPoints& shape, const DepthScan& scan) {
  check_scan(scan, "scan");
  check(shape.points_mm.size() == mesh.points_mm.size(), "shape has ", shape.points_mm.size(), " points, the mesh ",
        mesh.points_mm.size());
  MeshPoints result = shape;
  const std::vector<std::uint8_t> open = openings_of(scan);
  if (std::find(open.begin(), open.end(), 1) == open.end()) return result;
  const Edges edges = edges_of(mesh);
  std::array<std::vector<std::int64_t>, depths.size()> anchors;
  std::transform(depths.begin(), depths.end(), anchors.begin(), [&](int rings) { return anchors_of(edges, rings); });
  const ScanRays rays(scan.camera);
  const auto pixel_at = [&](double x, double y) {
    return index(scan, std::clamp(static_cast<int>(std::lround(x)), 0, scan.picture.width - 1),
                 std::clamp(static_cast<int>(std::lround(y)), 0, scan.picture.height - 1));
  };
  const auto lies_open = [&](std::size_t v) {
    const ScanPixel at = pixel_of(scan.camera, shape.points_mm[v]);
    return at.depth_mm > 0 && open[pixel_at(at.x_px, at.y_px)] == 1;
  };
  // The nearest anchor that is no part of what lies open; of a vertex deep in the mesh only if it lies open itself.
  const auto anchor_of = [&](std::size_t v) -> std::int64_t {
    if (anchors[0][v] < 0 && !lies_open(v)) return -1;
    for (const std::vector<std::int64_t>& anchor : anchors)
      if (anchor[v] >= 0 && !lies_open(static_cast<std::size_t>(anchor[v]))) return anchor[v];
    return -1;
  };
  for (std::size_t v = 0; v < shape.points_mm.size(); ++v) {
    const std::int64_t anchor = anchor_of(v);
    if (anchor < 0) continue;
    const ScanPixel from = pixel_of(scan.camera, shape.points_mm[static_cast<std::size_t>(anchor)]);
    const ScanPixel to = pixel_of(scan.camera, shape.points_mm[v]);
    if (!(from.depth_mm > 0 && to.depth_mm > 0)) continue;
    const double way_px = std::hypot(to.x_px - from.x_px, to.y_px - from.y_px);
    if (!(way_px < scan.picture.width + scan.picture.height)) continue;
    const int steps = static_cast<int>(std::ceil(way_px / step_px));
    double x = from.x_px, y = from.y_px;
    for (int i = 1; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      const double next_x = from.x_px + share * (to.x_px - from.x_px);
      const double next_y = from.y_px + share * (to.y_px - from.y_px);
      if (open[pixel_at(next_x, next_y)]) {
        const float depth = scan.depth_mm[pixel_at(x, y)];
        if (depth > 0) result.points_mm[v] = rays.point(x, y, depth);
        break;
      }
      x = next_x;
      y = next_y;
    }
  }
  return result;
}

}  // namespace face::model
