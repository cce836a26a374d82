// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/brows.h"

#include <numbers>

#include "nodes/phantom/head_surface.h"

namespace face::phantom {
namespace {

constexpr double kPi = std::numbers::pi;

Vector3 outward(ChartPoint at) {
  const double d = 0.5;
  const Vector3 u =
      skull_point({at.azimuth_deg + d, at.elevation_deg}) - skull_point({at.azimuth_deg - d, at.elevation_deg});
  const Vector3 v =
      skull_point({at.azimuth_deg, at.elevation_deg + d}) - skull_point({at.azimuth_deg, at.elevation_deg - d});
  return unit(cross(u, v));
}

// The skin's vertices about a point, the nearest with the largest weight; weights sum to 1.
std::vector<Anchor> nearby(const HeadBuilder& head, const Skin& skin, Vector3 point) {
  std::vector<Anchor> anchors;
  double sum = 0;
  for (std::uint32_t v = 0; v < skin.vertices.size(); ++v) {
    const double d = length(head.points_mm[v] - point);
    if (d > 9) continue;
    anchors.push_back({v, bell(d, 3.5)});
    sum += anchors.back().weight;
  }
  for (Anchor& anchor : anchors) anchor.weight /= sum;
  return anchors;
}

}  // namespace

Attached add_brows(HeadBuilder& head, const Skin& skin) {
  Attached brows;
  brows.range.first = head.vertex_count();
  const auto first_polygon = static_cast<std::uint32_t>(head.polygon_starts.size() - 1);
  head.begin_part("brows", {0.27, 0.175, 0.12}, 0.1);
  constexpr std::uint32_t kColumns = 22, kRows = 5;
  for (std::uint32_t c = 0; c < kColumns; ++c) {
    const double t = c / (kColumns - 1.0);
    const double azimuth = lerp(6.5, 35.0, t);
    const double elevation = 31.6 + 2.0 * std::sin(kPi * t * 0.85) - 2.4 * t * t * t;
    const double half_width = 1.55 * std::pow(std::sin(kPi * lerp(0.14, 0.985, std::pow(t, 0.75))), 0.7);  // degrees
    for (std::uint32_t r = 0; r < kRows; ++r) {
      const double w = r / (kRows - 1.0) * 2 - 1;
      const ChartPoint at = {azimuth - 0.5 * w * (1 - t), elevation + w * half_width};
      const Vector3 point =
          skin_point(at) +
          outward(at) * lerp(-0.6, 1.7, std::sqrt(1 - w * w) * smooth_step(-0.1, 0.25, t) * smooth_step(1.12, 0.7, t));
      head.add_vertex(point, {1, 1, 1});
      brows.anchors.push_back(nearby(head, skin, point));
    }
  }
  for (std::uint32_t c = 0; c + 1 < kColumns; ++c)
    for (std::uint32_t r = 0; r + 1 < kRows; ++r) {
      const std::uint32_t a = brows.range.first + c * kRows + r, b = a + kRows;
      head.add_polygon({a, b, b + 1, a + 1});
    }
  const std::uint32_t polygons = head.parts.back().polygon_count;
  head.add_mirror_image("brows", brows.range.first, first_polygon);
  head.parts.pop_back();
  head.parts.back().polygon_count = 2 * polygons;
  mirror_anchors(head, brows);
  brows.range.end = head.vertex_count();
  return brows;
}

}  // namespace face::phantom
