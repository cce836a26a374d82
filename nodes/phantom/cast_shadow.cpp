// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/cast_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/render/shade.h"

namespace face::phantom {
namespace {

// A sunflower disc of samples (Vogel, A Better Way to Construct the Sunflower Head, 1979).
constexpr std::size_t sample_count = 24;
std::array<std::array<float, 2>, sample_count> disc(float radius) {
  std::array<std::array<float, 2>, sample_count> samples{};
  for (std::size_t i = 0; i < sample_count; ++i) {
    const float r = radius * std::sqrt((static_cast<float>(i) + 0.5f) / sample_count);
    const float angle = 2.3999632f * static_cast<float>(i);
    samples[i] = {r * std::cos(angle), r * std::sin(angle)};
  }
  return samples;
}

}  // namespace

std::vector<float> cast_shadow(const std::vector<Vec3f>& points_mm, const std::vector<Vec3f>& normals,
                               const std::vector<render::Triangle>& triangles, const Vec3f& towards_light,
                               float softness_mm) {
  constexpr float px_per_mm = 1;
  constexpr float bias_mm = 2.5f;  // of depth, beside the shift along the normal
  constexpr float lift_mm = 1.5f;
  std::vector<float> seen(points_mm.size(), 1.0f);
  if (points_mm.empty()) return seen;
  using render::dot;
  const Vec3f up = std::abs(towards_light[1]) < 0.9f ? Vec3f{0, 1, 0} : Vec3f{1, 0, 0};
  const Vec3f& l = towards_light;
  const Vec3f right =
      render::normalized({up[1] * l[2] - up[2] * l[1], up[2] * l[0] - up[0] * l[2], up[0] * l[1] - up[1] * l[0]});
  const Vec3f above = {l[1] * right[2] - l[2] * right[1], l[2] * right[0] - l[0] * right[2],
                       l[0] * right[1] - l[1] * right[0]};
  Vec3f low = {1e9f, 1e9f, 1e9f}, high = {-1e9f, -1e9f, -1e9f};
  std::vector<Vec3f> lit(points_mm.size());  // right, above, towards the lamp
  for (std::size_t v = 0; v < points_mm.size(); ++v) {
    lit[v] = {dot(points_mm[v], right), dot(points_mm[v], above), dot(points_mm[v], l)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], lit[v][axis]);
      high[axis] = std::max(high[axis], lit[v][axis]);
    }
  }
  // The rasteriser keeps the larger 1 / depth, which is linear in the picture: for parallel light that is the nearness
  // to the lamp itself, scaled into (0.1, 0.9).
  const float range = std::max(1.0f, high[2] - low[2]);
  const auto nearness = [&](float along) { return 0.1f + 0.8f * (along - low[2]) / range; };
  std::vector<render::ScreenPoint> screen(lit.size());
  for (std::size_t v = 0; v < lit.size(); ++v)
    screen[v] = {(lit[v][0] - low[0]) * px_per_mm, (high[1] - lit[v][1]) * px_per_mm, 1 / nearness(lit[v][2])};
  render::RasterOptions options;
  options.width_px = std::clamp(static_cast<int>((high[0] - low[0]) * px_per_mm) + 1, 1, 2048);
  options.height_px = std::clamp(static_cast<int>((high[1] - low[1]) * px_per_mm) + 1, 1, 2048);
  options.culling = render::Culling::none;
  const render::Raster map = render::rasterize(screen, triangles, options);
  const auto samples = disc(softness_mm * px_per_mm);
  const float bias = 0.8f * bias_mm / range;
  for (std::size_t v = 0; v < lit.size(); ++v) {
    const Vec3f& n = normals[v];
    if (dot(n, l) <= -0.15f) continue;  // turned away: no light comes there anyway
    const float x = screen[v].x_px + lift_mm * dot(n, right) * px_per_mm;
    const float y = screen[v].y_px - lift_mm * dot(n, above) * px_per_mm;
    const float own = nearness(lit[v][2] + lift_mm * dot(n, l)) + bias;
    std::size_t hidden = 0;
    for (const auto& [dx, dy] : samples) {
      const int column = static_cast<int>(std::floor(x + dx + 0.5f)), row = static_cast<int>(std::floor(y + dy + 0.5f));
      if (column < 0 || row < 0 || column >= map.width_px || row >= map.height_px) continue;
      hidden += map.inverse_depth_per_mm[map.index(column, row)] > own ? 1 : 0;
    }
    seen[v] = 1.0f - static_cast<float>(hidden) / sample_count;
  }
  return seen;
}

}  // namespace face::phantom
