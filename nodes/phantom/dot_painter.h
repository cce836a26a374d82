// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "nodes/render/triangulate.h"
#include "nodes/types/mesh.h"
#include "nodes/types/surface_dots.h"

namespace face::phantom {

enum class ColourSpace { srgb, linear };

// Paints dots on a posed mesh, point by point, as surface_dots.h says. Their centres are hashed into cells, so that a
// point far from all of them costs one look-up.
class DotPainter {
 public:
  // dots null: paints nothing. points_mm: V x 3, the pose.
  DotPainter(const SurfaceDots* dots, const std::vector<Vec3f>& points_mm, const render::Triangulation& mesh,
             ColourSpace space);

  // Changes the colour of a point of the surface, in the frame of the pose.
  void paint(const Vec3f& point_mm, std::uint16_t part, Vec3f& colour) const {
    if (painted_.empty()) return;
    const std::int32_t first = first_at(point_mm);
    if (first >= 0) paint_listed(first, point_mm, part, colour);
  }

 private:
  struct Painted {
    Vec3f centre_mm;
    Vec3f colour;
    float radius_mm, edge_mm, opacity;
    std::uint16_t part;
  };
  struct Listed {
    std::uint32_t dot;
    std::int32_t next;
  };
  std::int32_t first_at(const Vec3f& point_mm) const;
  void paint_listed(std::int32_t first, const Vec3f& point_mm, std::uint16_t part, Vec3f& colour) const;

  std::vector<Painted> painted_;
  Vec3f low_mm_ = {0, 0, 0};
  std::array<int, 3> cells_ = {0, 0, 0};
  std::vector<std::int32_t> first_;  // per cell, index into listed_ or -1
  std::vector<Listed> listed_;
};

}  // namespace face::phantom
