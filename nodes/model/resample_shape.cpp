// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/resample_shape.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/model/cylinder_grid.h"
#include "nodes/model/scan_surface.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

// A grid about y as fine as the vertices are: only to find which triangle lies where.
CylinderScan finding_grid(const std::vector<Vec3f>& points) {
  CylinderScan grid;
  float low = 1e9f, high = -1e9f;
  double z = 0;
  for (const Vec3f& p : points) {
    low = std::min(low, p[1]);
    high = std::max(high, p[1]);
    z += static_cast<double>(p[2]) / static_cast<double>(points.size());
  }
  // An axis well behind the face: it is seen whole and once.
  constexpr float behind_mm = 60;
  grid.axis.origin_mm = {0, 0, static_cast<float>(z) - behind_mm};
  grid.step_mm = 0.6f;
  grid.top_mm = high + 2;
  grid.picture.width = 900;
  grid.picture.height = static_cast<int>((high - low + 4) / grid.step_mm);
  grid.phi_step_rad = 6.2831853f / 900;
  return grid;
}

struct Anchor {
  std::array<std::uint32_t, 3> vertices = {0, 0, 0};
  Vec3f weights = {1, 0, 0};
};

std::vector<Anchor> anchors_of(const MorphableModel& surface, std::size_t skin, const MeshPoints& mean,
                               const MeshPoints& places) {
  std::vector<render::Triangle> triangles;
  for (const render::Triangle& t : render::triangulate(surface.mean).triangles)
    if (t[0] < skin && t[1] < skin && t[2] < skin) triangles.push_back(t);
  const CylinderScan grid = finding_grid(mean.points_mm);
  const CylinderView view = view_cylinder(grid, mean.points_mm, triangles);
  std::vector<Anchor> anchors;
  anchors.reserve(places.points_mm.size());
  for (const Vec3f& place : places.points_mm) {
    const CylinderPixel pixel = cylinder_pixel(grid, place);
    const int x = static_cast<int>(std::lround(pixel.x_px)), y = static_cast<int>(std::lround(pixel.y_px));
    const bool inside = x >= 0 && y >= 0 && x < grid.picture.width && y < grid.picture.height;
    const std::int32_t found = inside ? view.raster.triangles[view.raster.index(x, y)] : -1;
    Anchor anchor;
    if (found >= 0) {
      anchor.vertices = triangles[static_cast<std::size_t>(found)];
      anchor.weights = render::barycentrics_at(view.screen, anchor.vertices, static_cast<float>(pixel.x_px),
                                               static_cast<float>(pixel.y_px));
      float sum = 0;
      for (float& w : anchor.weights) sum += w = std::max(w, 0.0f);
      for (float& w : anchor.weights) w /= sum;
    } else {
      float least = 1e30f;
      for (std::uint32_t v = 0; v < skin; ++v) {
        const Vec3f& p = mean.points_mm[v];
        const float d = (p[0] - place[0]) * (p[0] - place[0]) + (p[1] - place[1]) * (p[1] - place[1]) +
                        (p[2] - place[2]) * (p[2] - place[2]);
        if (d < least) least = d, anchor.vertices = {v, v, v};
      }
    }
    anchors.push_back(anchor);
  }
  return anchors;
}

}  // namespace

ResampleShapeResult resample_shape(const MeshPoints& shape, const Image& texture, const MorphableModel& surface,
                                   const MeshPoints& mean, const MeshPoints& anchors) {
  const std::size_t skin = skin_count(surface);
  check(shape.points_mm.size() == skin && mean.points_mm.size() == skin, "shape and mean have ", shape.points_mm.size(),
        " and ", mean.points_mm.size(), " vertices, the surface's skin has ", skin);
  check(texture.channels == 3 && texture.pixels.size() == 3 * skin, "texture has ", texture.pixels.size(),
        " bytes, expected 3 for each of ", skin, " vertices");
  check(skin > 0, "surface has no skin");
  ResampleShapeResult result;
  const std::vector<Anchor> places = anchors_of(surface, skin, mean, anchors);
  result.shape.points_mm = anchors.points_mm;
  result.texture = {static_cast<int>(places.size()), 1, 3, std::vector<std::uint8_t>(3 * places.size())};
  for (std::size_t v = 0; v < places.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) {
      float displacement = 0, colour = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t at = places[v].vertices[i];
        displacement += places[v].weights[i] * (shape.points_mm[at][k] - mean.points_mm[at][k]);
        colour += places[v].weights[i] * static_cast<float>(texture.pixels[3 * at + k]);
      }
      result.shape.points_mm[v][k] += displacement;
      result.texture.pixels[3 * v + k] = static_cast<std::uint8_t>(std::clamp(colour, 0.0f, 255.0f) + 0.5f);
    }
  return result;
}

MeshPoints add_expression(const MeshPoints& expression, const MeshPoints& neutral, const MeshPoints& other) {
  const std::size_t count = expression.points_mm.size();
  check(neutral.points_mm.size() == count && other.points_mm.size() == count, "shapes have ", count, ", ",
        neutral.points_mm.size(), " and ", other.points_mm.size(), " vertices, expected equal counts");
  MeshPoints result = other;
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t k = 0; k < 3; ++k) result.points_mm[v][k] += expression.points_mm[v][k] - neutral.points_mm[v][k];
  return result;
}

}  // namespace face::model
