// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/share_slopes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "nodes/transfer/pixel_lens.h"

namespace face::transfer {
namespace {

constexpr double beyond_parts = 0.75;  // where what lies beyond an edge is looked at

// A piece of the hole's edge, in parts of the view's pixels.
struct EdgePiece {
  std::uint32_t first, last;  // vertices
  double share;               // of the last
  double length;
  Place at, normal;  // out of the skin
};

double dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1]; }

std::vector<EdgePiece> pieces_of(const OpeningSheet& sheet, const OpeningPose& pose, const OpeningView& view) {
  std::vector<EdgePiece> pieces;
  const auto to_parts = [&](const Place& p) {
    return Place{(p[0] - view.left + 0.5) * parts_per_px, (p[1] - view.top + 0.5) * parts_per_px};
  };
  for (const OpeningSheet::HoleEdge& edge : sheet.hole) {
    const Place a = to_parts(pose.vertices[edge.first]), b = to_parts(pose.vertices[edge.last]);
    const double size = length(b - a);
    if (!(size > 1e-6)) continue;
    Place normal = {(b[1] - a[1]) / size, (a[0] - b[0]) / size};
    if (dot(normal, to_parts(pose.vertices[edge.inner]) - a) > 0) normal = -1 * normal;
    const int count = std::max(static_cast<int>(std::ceil(size)), 1);
    for (int i = 0; i < count; ++i) {
      const double share = (i + 0.5) / count;
      pieces.push_back({edge.first, edge.last, share, size / count, a + share * (b - a), normal});
    }
  }
  return pieces;
}

int part_of(double x) { return static_cast<int>(std::floor(x)); }

bool shows_skin(const OpeningView& view, const Place& at) {
  const int x = part_of(at[0]), y = part_of(at[1]);
  const bool within = x >= 0 && y >= 0 && x < view.parts.width_px && y < view.parts.height_px;
  return !within || view.parts.triangles[view.parts.index(x, y)] >= 0;
}

// The pixels that see a part: take(index, how much of the pixel it is).
template <class Take>
void each_seeing(int part_x, int part_y, const OpeningView& view, Take take) {
  const auto last = [](int part) { return (part + (lens_window - parts_per_px) / 2) / parts_per_px; };
  constexpr int most = lens_window / parts_per_px;
  for (int y = std::max(last(part_y) - most + 1, 0); y <= std::min(last(part_y), view.height - 1); ++y)
    for (int x = std::max(last(part_x) - most + 1, 0); x <= std::min(last(part_x), view.width - 1); ++x) {
      const auto i = static_cast<std::size_t>(part_x - first_part(x));
      const auto j = static_cast<std::size_t>(part_y - first_part(y));
      take(view.index(view.left + x, view.top + y), lens_weights()[i] * lens_weights()[j]);
    }
}

}  // namespace

std::vector<std::vector<ShareSlope>> share_slopes(const OpeningSheet& sheet, const OpeningPose& pose,
                                                  const OpeningView& view) {
  std::vector<std::map<std::uint32_t, Place>> slopes(view.pixels.size());
  for (const EdgePiece& piece : pieces_of(sheet, pose, view)) {
    const int x = part_of(piece.at[0]), y = part_of(piece.at[1]);
    if (x < 0 || y < 0 || x >= view.parts.width_px || y >= view.parts.height_px) continue;
    if (shows_skin(view, piece.at + beyond_parts * piece.normal)) continue;
    // Moved by a pixel it sweeps so many parts, each of which counts in a pixel by the lens.
    const double swept = piece.length * parts_per_px;
    each_seeing(x, y, view, [&](std::size_t pixel, double weight) {
      for (const auto& [vertex, share] :
           {std::pair(piece.first, 1 - piece.share), std::pair(piece.last, piece.share)}) {
        Place& slope = slopes[pixel].try_emplace(vertex, Place{0, 0}).first->second;
        slope = slope + (weight * swept * share) * piece.normal;
      }
    });
  }
  std::vector<std::vector<ShareSlope>> out(slopes.size());
  for (std::size_t i = 0; i < slopes.size(); ++i)
    for (const auto& [vertex, slope] : slopes[i]) out[i].push_back({vertex, slope});
  return out;
}

}  // namespace face::transfer
