// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/find_openings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/base/scan_points.h"
#include "nodes/render/camera.h"
#include "nodes/render/triangulate.h"
#include "nodes/transfer/pixel_parts.h"
#include "nodes/transfer/squeezed_triangles.h"
#include "nodes/transfer/trace_outline.h"

namespace face::transfer {
namespace {

// In edges of the mesh, to which what is hidden is known: what no frame hides quite, and what hangs together by a
// thread; nearer to what is not measured is a lip; an opening has so many vertices.
constexpr int closed_edges = 2, thread_edges = 1, lip_edges = 2, fewest_vertices = 15;

// How many frames hide each pixel of the reference.
std::vector<int> hidden_counts(const Mesh& mesh, const DepthScan& reference, const engine::Seq<MeshPoints>& shapes,
                               const engine::Seq<DepthScan>& frames, double least_area) {
  const Image& picture = reference.picture;
  const std::vector<render::Triangle> triangles = render::triangulate(mesh).triangles;
  const std::vector<render::ScreenPoint> before = places_in_picture(mesh, picture);
  std::vector<int> frames_hidden(triangles.size(), 0);
  for (std::size_t f = 0; f < shapes.size(); ++f) {
    const std::shared_ptr<const MeshPoints> shape = shapes.at(f);
    check(shape->points_mm.size() == mesh.points_mm.size(), "shape ", shapes.id(f), " has ", shape->points_mm.size(),
          " points, the mesh ", mesh.points_mm.size());
    const std::vector<bool> squeezed =
        squeezed_triangles(triangles, before, render::project(frames.at(f)->camera, shape->points_mm), least_area);
    for (std::size_t i = 0; i < triangles.size(); ++i) frames_hidden[i] += squeezed[i] ? 1 : 0;
  }
  const render::Raster raster = render::rasterize(
      before, triangles,
      {.width_px = picture.width, .height_px = picture.height, .near_mm = 0.5f, .culling = render::Culling::none});
  std::vector<int> counts;
  for (const std::int32_t t : raster.triangles)
    counts.push_back(t < 0 ? 0 : frames_hidden[static_cast<std::size_t>(t)]);
  return counts;
}

// How long the shortest edge of most polygons is in the reference's picture, whole pixels.
int edge_length_px(const Mesh& mesh, const Image& picture) {
  constexpr double longest = 16;
  std::vector<double> shortest;
  for (std::size_t p = 0; p < mesh.polygon_count(); ++p) {
    double least = longest;
    for (std::uint32_t first = mesh.polygon_starts[p], last = mesh.polygon_starts[p + 1], k = first; k < last; ++k) {
      const Vec2f &a = mesh.uvs[mesh.corners[k]], &b = mesh.uvs[mesh.corners[k + 1 < last ? k + 1 : first]];
      least = std::min(least, length({static_cast<double>(b[0] - a[0]) * picture.width,
                                      static_cast<double>(b[1] - a[1]) * picture.height}));
    }
    shortest.push_back(least);
  }
  return static_cast<int>(std::lround(std::max(1.0, median(shortest))));
}

}  // namespace

Landmarks find_openings(const Mesh& mesh, const DepthScan& reference, const engine::Seq<MeshPoints>& shapes,
                        const engine::Seq<DepthScan>& frames, const FindOpeningsOptions& options) {
  check_scan(reference, "reference");
  check(mesh.uvs.size() == mesh.points_mm.size(), "mesh has ", mesh.uvs.size(), " uvs, expected one for each of its ",
        mesh.points_mm.size(), " points");
  check(shapes.size() == frames.size(), "shapes has ", shapes.size(), " elements, frames ", frames.size());
  const std::vector<int> counts = hidden_counts(mesh, reference, shapes, frames, options.least_area);
  const int width = reference.picture.width, height = reference.picture.height;
  PixelFlags hidden(width, height), edge(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      hidden.set(x, y, counts[i] >= options.fewest_frames);
      edge.set(x, y, !(reference.depth_mm[i] > 0));
    }
  const int edge_px = edge_length_px(mesh, reference.picture);
  hidden = hidden.grown(closed_edges * edge_px).shrunk(closed_edges * edge_px);
  hidden = hidden.shrunk(thread_edges * edge_px).grown(thread_edges * edge_px);
  edge = edge.grown(lip_edges * edge_px);
  Landmarks openings;
  int number = 0;
  for (const Pixels& part : parts_of(hidden)) {
    const bool at_edge =
        std::any_of(part.begin(), part.end(), [&](const auto& pixel) { return edge.at(pixel[0], pixel[1]); });
    if (part.size() < static_cast<std::size_t>(fewest_vertices * edge_px * edge_px) || at_edge) continue;
    std::vector<Place> border;
    for (const auto& [x, y] : border_of(part)) border.push_back({static_cast<double>(x), static_cast<double>(y)});
    const Outline outline = trace_outline(reference.picture, border);
    ++number;
    for (std::size_t i = 0; i < outline.corners.size(); ++i)
      openings.points.push_back(
          {std::to_string(number) + "." + std::to_string(i), outline.corners[i][0], outline.corners[i][1], true});
  }
  return openings;
}

}  // namespace face::transfer
