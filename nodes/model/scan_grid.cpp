// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/scan_grid.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "nodes/base/scan_points.h"

namespace face::model {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

constexpr int sweeps = 12;  // a stair of six strides' length becomes a slope
constexpr float farthest_strides = 0.8f;

std::size_t pixel_at(const DepthScan& scan, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(scan.picture.width) + static_cast<std::size_t>(x);
}

bool measured(const DepthScan& scan, const Vec2f& place) {
  const int x = static_cast<int>(std::lround(place[0])), y = static_cast<int>(std::lround(place[1]));
  return x >= 0 && y >= 0 && x < scan.picture.width && y < scan.picture.height &&
         scan.depth_mm[pixel_at(scan, x, y)] > 0;
}

Vec3f point_at(const DepthScan& scan, const ScanRays& rays, const Vec2f& place) {
  const auto x = static_cast<double>(place[0]), y = static_cast<double>(place[1]);
  const float between = depth_at(scan, x, y);
  const int column = static_cast<int>(std::lround(x)), row = static_cast<int>(std::lround(y));
  return rays.point(x, y, between > 0 ? between : scan.depth_mm[pixel_at(scan, column, row)]);
}

std::vector<Triangle> triangles_of(const ScanGrid& grid, double longest_edge_mm) {
  std::vector<Triangle> triangles;
  const auto near = [&](std::int32_t a, std::int32_t b) {
    const Vec3f &p = grid.point_mm[static_cast<std::size_t>(a)], &q = grid.point_mm[static_cast<std::size_t>(b)];
    return static_cast<double>(std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2])) <= longest_edge_mm;
  };
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    if (a < 0 || b < 0 || c < 0 || !near(a, b) || !near(b, c) || !near(c, a)) return;
    triangles.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  };
  for (int r = 0; r + 1 < grid.rows; ++r)
    for (int c = 0; c + 1 < grid.columns; ++c) {
      const std::int32_t* above = grid.vertex.data() + static_cast<std::ptrdiff_t>(r) * grid.columns + c;
      const std::int32_t *below = above + grid.columns, a = above[0], b = above[1], d = below[0], e = below[1];
      // Rows run downwards.
      if (a >= 0 && e >= 0 && (b < 0 || d < 0)) {
        add(a, d, e);
        add(a, e, b);
      } else {
        add(a, d, b);
        add(b, d, e);
      }
    }
  return triangles;
}

// The two neighbours along the mesh's edge of every vertex that lies on one edge line alone.
std::map<std::uint32_t, std::array<std::uint32_t, 2>> neighbours_along_edges(const std::vector<Triangle>& triangles) {
  std::map<std::array<std::uint32_t, 2>, int> uses;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  std::map<std::uint32_t, std::vector<std::uint32_t>> about;
  for (const auto& [edge, count] : uses)
    if (count == 1) {
      about[edge[0]].push_back(edge[1]);
      about[edge[1]].push_back(edge[0]);
    }
  std::map<std::uint32_t, std::array<std::uint32_t, 2>> pairs;
  for (const auto& [vertex, others] : about)
    if (others.size() == 2) pairs[vertex] = {others[0], others[1]};
  return pairs;
}

void smooth_edges(ScanGrid& grid, const DepthScan& reference, int stride_px) {
  const auto pairs = neighbours_along_edges(grid.triangles);
  const std::vector<Vec2f> first = grid.place_px;
  const float farthest = farthest_strides * static_cast<float>(stride_px);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const std::vector<Vec2f> before = grid.place_px;
    for (const auto& [v, others] : pairs) {
      Vec2f moved{};
      for (std::size_t k = 0; k < 2; ++k) {
        const float mean = 0.5f * before[v][k] + 0.25f * (before[others[0]][k] + before[others[1]][k]);
        moved[k] = std::clamp(mean, first[v][k] - farthest, first[v][k] + farthest);
      }
      if (measured(reference, moved)) grid.place_px[v] = moved;
    }
  }
}

}  // namespace

ScanGrid scan_grid(const DepthScan& reference, int stride_px, double longest_edge_mm) {
  check_scan(reference, "reference");
  ScanGrid grid;
  grid.columns = (reference.picture.width + stride_px - 1) / stride_px;
  grid.rows = (reference.picture.height + stride_px - 1) / stride_px;
  const ScanRays rays(reference.camera);
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      const Vec2f place = {static_cast<float>(c * stride_px), static_cast<float>(r * stride_px)};
      const bool there = measured(reference, place);
      grid.vertex.push_back(there ? static_cast<std::int32_t>(grid.place_px.size()) : -1);
      if (!there) continue;
      grid.place_px.push_back(place);
      grid.point_mm.push_back(point_at(reference, rays, place));
    }
  grid.triangles = triangles_of(grid, longest_edge_mm);
  smooth_edges(grid, reference, stride_px);
  for (std::size_t v = 0; v < grid.place_px.size(); ++v) grid.point_mm[v] = point_at(reference, rays, grid.place_px[v]);
  return grid;
}

}  // namespace face::model
