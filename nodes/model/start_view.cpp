// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/start_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/model/light_model.h"
#include "nodes/render/shade.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

constexpr double least_facing = 0.35;   // cosine of normal and line of sight below which a pixel holds too much skin
constexpr double depth_slack_mm = 3;    // of a point behind what its pixel shows; larger pixels hold more depth
constexpr double darkest_light = 0.03;  // below, its inverse is noise
constexpr double least_albedo = 1e-4;

}  // namespace

StartView start_view(const SkinBasis& basis, const std::vector<double>& identity, const PictureState& state,
                     const FloatPicture& picture, double factor) {
  StartView result;
  result.state = state;
  result.points_mm = posed_skin(basis, identity, state.expression);
  result.normals = render::vertex_normals(result.points_mm, basis.triangles);
  result.level = make_level(picture, factor);
  result.drawn = draw_skin(basis, result.points_mm, state.pose, result.level);
  return result;
}

void colour_points(const StartView& view, const SkinBasis& basis, std::vector<SkinPoint>& points) {
  const PictureState& state = view.state;
  const render::Raster& raster = view.drawn.raster;
  Vec3f towards{};  // the light, in the head's frame
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t row = 0; row < 3; ++row)
      towards[k] += static_cast<float>(state.pose.rotation[3 * row + k]) * state.light.direction[row];
  const Vec3f eye = camera_of(state.pose).position_mm;
  for (SkinPoint& point : points) {
    point.mirrors = false;
    const auto& triangle = basis.triangles[point.triangle];
    Vec3f at{}, normal{};
    double share = 0, depth = 0, x = 0, y = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = triangle[i];
      const float b = point.weights[i];
      for (std::size_t k = 0; k < 3; ++k) {
        at[k] += b * view.points_mm[v][k];
        normal[k] += b * view.normals[v][k];
      }
      const render::ScreenPoint& corner = view.drawn.screen[v];
      share += static_cast<double>(b) * (state.seen.empty() ? 1.0 : static_cast<double>(state.seen[v]));
      depth += static_cast<double>(b) * corner.depth_mm;
      x += static_cast<double>(b) * corner.x_px;
      y += static_cast<double>(b) * corner.y_px;
    }
    normal = render::normalized(normal);
    const Vec3f ray = render::normalized({eye[0] - at[0], eye[1] - at[1], eye[2] - at[2]});
    if (render::dot(normal, ray) < least_facing) continue;
    const long px = std::lround(x), py = std::lround(y);
    if (px < 0 || py < 0 || px >= raster.width_px || py >= raster.height_px) continue;
    const float inverse = raster.inverse_depth_per_mm[raster.index(static_cast<int>(px), static_cast<int>(py))];
    if (inverse > 0 && depth > 1.0 / static_cast<double>(inverse) + depth_slack_mm / view.level.factor) continue;
    const std::array<float, 9> seen = sample_at(view.level, x, y);
    const std::array<double, 3> lit = lit_of(state.light, {seen[0], seen[1], seen[2]});
    const double cosine = share * static_cast<double>(render::dot(normal, towards));
    double mirrored = 0;
    if (cosine > 0) {
      const Vec3f halfway = render::normalized({towards[0] + ray[0], towards[1] + ray[1], towards[2] + ray[2]});
      const Lobes lobes = lobes_at(static_cast<double>(render::dot(normal, halfway)));
      for (std::size_t k = 0; k < lobes.value.size(); ++k)
        mirrored += share * static_cast<double>(state.light.mirror[k]) * lobes.value[k];
    }
    Vec3f albedo;
    bool dark = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const double strength = light_at(state.light, c, cosine);
      dark = dark || strength < darkest_light;
      const double scattered = lit[c] - mirrored * static_cast<double>(state.light.parallel[c]);
      albedo[c] = static_cast<float>(std::max(least_albedo, scattered / strength));
    }
    if (dark) continue;
    point.albedo = albedo;
    point.mirrors = true;
  }
}

}  // namespace face::model
