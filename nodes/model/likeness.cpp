// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/likeness.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "nodes/model/light_model.h"
#include "nodes/render/camera.h"
#include "nodes/render/rasterize.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

double luminance(const float* rgb) { return luma[0] * rgb[0] + luma[1] * rgb[1] + luma[2] * rgb[2]; }

}  // namespace

double likeness(const Joint& joint, std::size_t index, const PictureLevel& level) {
  const PictureState& state = joint.pictures[index].state;
  const SkinBasis& basis = joint.basis;
  const std::vector<Vec3f> points = posed_skin(basis, joint.identity, state.expression);
  const std::vector<Vec3f> albedo = skin_albedo(basis, joint.albedo);
  const std::vector<Vec3f> normals = render::vertex_normals(points, basis.triangles);
  const std::vector<render::ScreenPoint> screen = render::project(camera_of(scaled(state.pose, level.factor)), points);
  render::RasterOptions options;
  options.width_px = level.width;
  options.height_px = level.height;
  const render::Raster raster = render::rasterize(screen, basis.triangles, options);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(state.pose.rotation.data());
  const Eigen::Vector3d light =
      rotation.transpose() *
      Eigen::Vector3d(state.light.direction[0], state.light.direction[1], state.light.direction[2]);
  // What every vertex looks like; between them as light and albedo are, all but linear.
  std::vector<float> shade(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vec3f& n = normals[v];
    const double cosine = (state.seen.empty() ? 1.0 : static_cast<double>(state.seen[v])) *
                          (static_cast<double>(n[0]) * light[0] + static_cast<double>(n[1]) * light[1] +
                           static_cast<double>(n[2]) * light[2]);
    std::array<double, 3> lit{};
    for (std::size_t c = 0; c < 3; ++c)
      lit[c] = light_at(state.light, c, cosine) * std::max(1e-4, static_cast<double>(albedo[v][c]));
    const std::array<double, 3> value = shown(state.light, lit);
    shade[v] = static_cast<float>(luma[0] * value[0] + luma[1] * value[1] + luma[2] * value[2]);
  }
  std::vector<float> drawn(raster.triangles.size(), 0.0f);
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      const std::size_t pixel = raster.index(x, y);
      if (raster.triangles[pixel] < 0) continue;
      const auto& triangle = basis.triangles[static_cast<std::size_t>(raster.triangles[pixel])];
      const Vec3f b = render::barycentrics_at(screen, triangle, static_cast<float>(x), static_cast<float>(y));
      for (std::size_t i = 0; i < 3; ++i) drawn[pixel] += b[i] * shade[triangle[i]];
    }
  // Hair over the forehead has more edges than all of the face.
  const std::vector<std::uint32_t>& marks = joint.model->landmarks68;
  const auto height = [&](std::size_t mark) { return joint.model->mean.points_mm[marks[mark]][1]; };
  const float top = marks.size() == 68 ? std::min(height(19), height(24)) : 1e9f;
  double both = 0, own = 0, picture = 0;
  for (int y = 1; y + 1 < level.height; ++y)
    for (int x = 1; x + 1 < level.width; ++x) {
      const std::size_t here = raster.index(x, y), left = raster.index(x - 1, y), right = raster.index(x + 1, y),
                        up = raster.index(x, y - 1), down = raster.index(x, y + 1);
      if (raster.triangles[here] < 0 || raster.triangles[left] < 0 || raster.triangles[right] < 0 ||
          raster.triangles[up] < 0 || raster.triangles[down] < 0)
        continue;
      if (basis.mean_mm[basis.triangles[static_cast<std::size_t>(raster.triangles[here])][0]][1] > top) continue;
      const double mx = 0.5 * (static_cast<double>(drawn[right]) - drawn[left]);
      const double my = 0.5 * (static_cast<double>(drawn[down]) - drawn[up]);
      const double px = luminance(level.samples[here].data() + 3), py = luminance(level.samples[here].data() + 6);
      both += mx * px + my * py;
      own += mx * mx + my * my;
      picture += px * px + py * py;
    }
  return own > 0 && picture > 0 ? both / std::sqrt(own * picture) : 0;
}

}  // namespace face::model
