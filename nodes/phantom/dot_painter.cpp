// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/dot_painter.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/phantom/head_view.h"
#include "nodes/phantom/vector3.h"
#include "nodes/render/shade.h"

namespace face::phantom {
namespace {

constexpr float cell_mm = 8;

float reach_of(const SurfaceDot& dot) { return dot.radius_mm + 0.5f * dot.edge_mm; }

}  // namespace

DotPainter::DotPainter(const SurfaceDots* dots, const std::vector<Vec3f>& points_mm, const render::Triangulation& mesh,
                       ColourSpace space) {
  if (dots == nullptr || dots->dots.empty()) return;
  const render::SrgbTable srgb;
  const std::vector<std::uint16_t> parts = part_of_vertices(points_mm.size(), mesh);
  Vec3f high = {-1e9f, -1e9f, -1e9f};
  low_mm_ = {1e9f, 1e9f, 1e9f};
  for (const SurfaceDot& dot : dots->dots) {
    Painted painted{{0, 0, 0}, dot.color_srgb, dot.radius_mm, dot.edge_mm, dot.opacity, 0};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t v = dot.vertices[corner];
      check(v < points_mm.size(), "dot \"", dot.name, "\" lies on vertex ", v, ", but the mesh has ", points_mm.size());
      for (std::size_t axis = 0; axis < 3; ++axis) painted.centre_mm[axis] += dot.weights[corner] * points_mm[v][axis];
    }
    painted.part = parts[dot.vertices[0]];
    if (space == ColourSpace::linear)
      for (float& channel : painted.colour) channel = srgb.linear(channel);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low_mm_[axis] = std::min(low_mm_[axis], painted.centre_mm[axis] - reach_of(dot));
      high[axis] = std::max(high[axis], painted.centre_mm[axis] + reach_of(dot));
    }
    painted_.push_back(painted);
  }
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cells_[axis] = static_cast<int>((high[axis] - low_mm_[axis]) / cell_mm) + 1;
    count *= static_cast<std::size_t>(cells_[axis]);
  }
  check(count < (std::size_t{1} << 24), "the dots lie ", high[0] - low_mm_[0], " x ", high[1] - low_mm_[1], " x ",
        high[2] - low_mm_[2], " mm apart, expected a head's size");
  first_.assign(count, -1);
  // Backwards, so that every cell's list runs in the dots' order: later ones lie over earlier ones.
  for (std::size_t i = painted_.size(); i-- > 0;) {
    const Vec3f& c = painted_[i].centre_mm;
    const float reach = reach_of(dots->dots[i]);
    std::array<int, 3> from, to;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      from[axis] = std::max(0, static_cast<int>((c[axis] - reach - low_mm_[axis]) / cell_mm));
      to[axis] = std::min(cells_[axis] - 1, static_cast<int>((c[axis] + reach - low_mm_[axis]) / cell_mm));
    }
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x) {
          std::int32_t& first = first_[static_cast<std::size_t>((z * cells_[1] + y) * cells_[0] + x)];
          listed_.push_back({static_cast<std::uint32_t>(i), first});
          first = static_cast<std::int32_t>(listed_.size() - 1);
        }
  }
}

std::int32_t DotPainter::first_at(const Vec3f& point_mm) const {
  std::array<int, 3> cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float position = (point_mm[axis] - low_mm_[axis]) / cell_mm;
    if (!(position >= 0)) return -1;
    if (position >= static_cast<float>(cells_[axis])) return -1;
    cell[axis] = static_cast<int>(position);
  }
  return first_[static_cast<std::size_t>((cell[2] * cells_[1] + cell[1]) * cells_[0] + cell[0])];
}

void DotPainter::paint_listed(std::int32_t first, const Vec3f& point_mm, std::uint16_t part, Vec3f& colour) const {
  for (std::int32_t i = first; i >= 0; i = listed_[static_cast<std::size_t>(i)].next) {
    const Painted& dot = painted_[listed_[static_cast<std::size_t>(i)].dot];
    if (dot.part != part) continue;
    const float dx = point_mm[0] - dot.centre_mm[0], dy = point_mm[1] - dot.centre_mm[1],
                dz = point_mm[2] - dot.centre_mm[2];
    const float distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    const float outer = dot.radius_mm + 0.5f * dot.edge_mm;
    if (distance >= outer) continue;
    const double faded = dot.edge_mm > 0 ? smooth_step(dot.radius_mm - 0.5 * dot.edge_mm, outer, distance) : 0.0;
    const float opacity = dot.opacity * static_cast<float>(1 - faded);
    for (std::size_t c = 0; c < 3; ++c) colour[c] += opacity * (dot.colour[c] - colour[c]);
  }
}

}  // namespace face::phantom
