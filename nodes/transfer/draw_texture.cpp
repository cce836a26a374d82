// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/draw_texture.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/sample_image.h"
#include "nodes/base/scan_points.h"
#include "nodes/render/camera.h"
#include "nodes/render/triangulate.h"

namespace face::transfer {
namespace {

double grey_of(const Image& picture, int x, int y) {
  const std::uint8_t* p = picture.pixels.data() +
                          static_cast<std::size_t>(y * picture.width + x) * static_cast<std::size_t>(picture.channels);
  return picture.channels < 3 ? p[0] : 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
}

double grey_at(const Image& picture, double x, double y) {
  float values[4];
  sample_image(picture, x, y, values);
  return picture.channels < 3 ? values[0] : 0.299 * values[0] + 0.587 * values[1] + 0.114 * values[2];
}

}  // namespace

DrawTextureResult draw_texture(const Mesh& mesh, const DepthScan& reference, const MeshPoints& shape,
                               const DepthScan& frame, const DepthScan* seen) {
  check_scan(reference, "reference");
  check_scan(frame, "frame");
  check(mesh.uvs.size() == mesh.points_mm.size(), "mesh has ", mesh.uvs.size(), " uvs, expected one for each of its ",
        mesh.points_mm.size(), " points");
  check(shape.points_mm.size() == mesh.points_mm.size(), "shape has ", shape.points_mm.size(), " points, the mesh ",
        mesh.points_mm.size());
  const int width = frame.picture.width, height = frame.picture.height;
  const Image& picture = seen ? seen->picture : frame.picture;
  if (seen) check_scan(*seen, "seen");
  check(picture.width == width && picture.height == height, "seen is ", picture.width, " x ", picture.height,
        " pixels, frame ", width, " x ", height);
  const std::vector<render::ScreenPoint> screen = render::project(frame.camera, shape.points_mm);
  const render::Triangulation cut = render::triangulate(mesh);
  const render::Raster raster = render::rasterize(screen, cut.triangles, {.width_px = width, .height_px = height});
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
      const render::Triangle& corners = cut.triangles[static_cast<std::size_t>(triangle)];
      const Vec3f b = render::barycentrics_at(screen, corners, static_cast<float>(x), static_cast<float>(y));
      double u = 0, v = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        u += static_cast<double>(b[k]) * static_cast<double>(mesh.uvs[corners[k]][0]);
        v += static_cast<double>(b[k]) * static_cast<double>(mesh.uvs[corners[k]][1]);
      }
      result.drawn.pixels.push_back(to_byte(
          grey_at(reference.picture, u * reference.picture.width - 0.5, (1 - v) * reference.picture.height - 0.5)));
    }
  return result;
}

}  // namespace face::transfer
