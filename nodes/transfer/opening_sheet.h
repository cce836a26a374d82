// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "nodes/render/rasterize.h"
#include "nodes/transfer/outline.h"

namespace face::transfer {

constexpr int sheet_stride_px = 2;

// The skin about an opening in the reference's picture: a grid of vertices, every sheet_stride_px, and those where its
// lines meet the outline. No triangle lies inside.
struct OpeningSheet {
  struct Line {  // second difference: first - (1 + share) * middle + share * last is kept small
    std::array<std::uint32_t, 3> vertices;
    double share;
    bool along_outline;
  };
  std::vector<Place> places;
  std::vector<render::Triangle> triangles;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<Line> lines;
  struct HoleEdge {  // from first to last; inner is the third vertex of its triangle
    std::uint32_t first, last, inner;
  };
  std::vector<HoleEdge> hole;      // the edges of triangles that lie at the outline
  std::vector<std::uint32_t> rim;  // the outermost vertices, in order about the sheet
  int left = 0, top = 0, columns = 0, rows = 0;
  double light_px = 0;  // distance of the places where light is told
};
OpeningSheet opening_sheet(const Outline& outline);

}  // namespace face::transfer
