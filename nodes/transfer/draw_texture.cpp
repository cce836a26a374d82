// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/draw_texture.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/grey_spline.h"
#include "nodes/base/luma.h"
#include "nodes/base/sample_image.h"
#include "nodes/base/scan_points.h"
#include "nodes/render/camera.h"
#include "nodes/render/triangulate.h"
#include "nodes/transfer/squeezed_triangles.h"

namespace face::transfer {
namespace {

double grey_of(const Image& picture, int x, int y) {
  const std::uint8_t* p = picture.pixels.data() +
                          static_cast<std::size_t>(y * picture.width + x) * static_cast<std::size_t>(picture.channels);
  return grey_value<double>(p, picture.channels);
}

// Triangles that are squeezed to nothing, and those beside them: a pixel sees an area, so that the edge of what hides
// has in the reference some of the colour of what it hides in the frame.
std::vector<bool> hidden_triangles(const std::vector<render::Triangle>& triangles, const Mesh& mesh,
                                   const Image& picture, const std::vector<render::ScreenPoint>& screen,
                                   double least_area) {
  const std::vector<bool> squeezed =
      squeezed_triangles(triangles, places_in_picture(mesh, picture), screen, least_area);
  std::vector<bool> touched(screen.size(), false), hidden;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (squeezed[i])
      for (const std::uint32_t v : triangles[i]) touched[v] = true;
  for (const render::Triangle& t : triangles) hidden.push_back(touched[t[0]] || touched[t[1]] || touched[t[2]]);
  return hidden;
}

// Pixels that are still to be drawn take the mean of those about them that are drawn, from the border inwards.
void fill_from_border(const Image& mask, std::vector<std::size_t> empty, Image& picture) {
  const int width = picture.width, height = picture.height;
  std::vector<bool> known;
  for (const std::uint8_t m : mask.pixels) known.push_back(m > 0);
  for (const std::size_t i : empty) known[i] = false;
  while (!empty.empty()) {
    std::vector<std::pair<std::size_t, std::uint8_t>> found;
    std::vector<std::size_t> left;
    for (const std::size_t i : empty) {
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      int sum = 0, count = 0;
      for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny)
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width - 1); ++nx) {
          const auto n = static_cast<std::size_t>(ny) * static_cast<std::size_t>(width) + static_cast<std::size_t>(nx);
          if (!known[n]) continue;
          sum += picture.pixels[n];
          ++count;
        }
      if (count > 0)
        found.push_back({i, static_cast<std::uint8_t>((sum + count / 2) / count)});
      else
        left.push_back(i);
    }
    if (found.empty()) return;
    for (const auto& [i, grey] : found) {
      picture.pixels[i] = grey;
      known[i] = true;
    }
    empty = std::move(left);
  }
}

// Takes off a mask what lies beside a pixel of the picture that is not in it, in its row or column.
void take_off_edge(Image& mask) {
  const std::vector<std::uint8_t> before = mask.pixels;
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(x);
  };
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (before[at(std::max(x - 1, 0), y)] == 0 || before[at(std::min(x + 1, mask.width - 1), y)] == 0 ||
          before[at(x, std::max(y - 1, 0))] == 0 || before[at(x, std::min(y + 1, mask.height - 1))] == 0)
        mask.pixels[at(x, y)] = 0;
}

}  // namespace

void check_texture(const Mesh& mesh, const DepthScan& reference, const MeshPoints& shape, const DepthScan& frame) {
  check_scan(reference, "reference");
  check_scan(frame, "frame");
  check(mesh.uvs.size() == mesh.points_mm.size(), "mesh has ", mesh.uvs.size(), " uvs, expected one for each of its ",
        mesh.points_mm.size(), " points");
  check(shape.points_mm.size() == mesh.points_mm.size(), "shape has ", shape.points_mm.size(), " points, the mesh ",
        mesh.points_mm.size());
}

DrawTextureResult draw_texture(const Mesh& mesh, const DepthScan& reference, const MeshPoints& shape,
                               const DepthScan& frame, const DepthScan* seen, const DrawTextureOptions& options) {
  check_texture(mesh, reference, shape, frame);
  const int width = frame.picture.width, height = frame.picture.height;
  const Image& picture = seen ? seen->picture : frame.picture;
  if (seen) check_scan(*seen, "seen");
  check(picture.width == width && picture.height == height, "seen is ", picture.width, " x ", picture.height,
        " pixels, frame ", width, " x ", height);
  const std::vector<render::ScreenPoint> screen = render::project(frame.camera, shape.points_mm);
  const render::Triangulation cut = render::triangulate(mesh);
  const render::Raster raster = render::rasterize(screen, cut.triangles, {.width_px = width, .height_px = height});
  const std::vector<bool> hidden = hidden_triangles(cut.triangles, mesh, reference.picture, screen, options.least_area);
  const GreySpline texture(reference.picture);
  std::vector<std::size_t> empty;
  DrawTextureResult result;
  result.drawn = result.picture = result.mask = {width, height, 1, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      result.picture.pixels.push_back(to_byte(grey_of(picture, x, y)));
      const std::int32_t triangle = raster.triangles[raster.index(x, y)];
      result.mask.pixels.push_back(triangle >= 0 ? 255 : 0);
      if (triangle < 0) {
        result.drawn.pixels.push_back(0);
        continue;
      }
      if (hidden[static_cast<std::size_t>(triangle)]) {
        empty.push_back(raster.index(x, y));
        result.drawn.pixels.push_back(0);
        continue;
      }
      const render::Triangle& corners = cut.triangles[static_cast<std::size_t>(triangle)];
      const Vec3f b = render::barycentrics_at(screen, corners, static_cast<float>(x), static_cast<float>(y));
      double u = 0, v = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        u += static_cast<double>(b[k]) * static_cast<double>(mesh.uvs[corners[k]][0]);
        v += static_cast<double>(b[k]) * static_cast<double>(mesh.uvs[corners[k]][1]);
      }
      result.drawn.pixels.push_back(
          to_byte(texture.at(u * reference.picture.width - 0.5, (1 - v) * reference.picture.height - 0.5)));
    }
  fill_from_border(result.mask, std::move(empty), result.drawn);
  for (std::int64_t i = 0; i < options.edge_px; ++i) take_off_edge(result.mask);
  return result;
}

}  // namespace face::transfer
