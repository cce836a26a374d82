// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/start_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "nodes/model/light_model.h"
#include "nodes/render/shade.h"
#include "nodes/render/triangulate.h"

namespace face::model {
namespace {

constexpr double least_facing = 0.35;   // cosine of normal and line of sight below which a pixel holds too much skin
constexpr double depth_slack_mm = 3;    // of a point behind what its pixel shows; larger pixels hold more depth
constexpr double darkest_light = 0.03;  // below, its inverse is noise
constexpr double least_albedo = 1e-4;

// Directions and places in the head's frame.
struct Seen {
  Vec3f towards;  // the light
  Vec3f eye;
};

Vec3f between(const std::vector<Vec3f>& corners, const std::array<std::uint32_t, 3>& triangle, const Vec3f& weights) {
  Vec3f at{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) at[k] += weights[i] * corners[triangle[i]][k];
  return at;
}

// The reflectance that the picture shows at a point of the skin, if it does.
std::optional<Vec3f> reflectance_at(const StartView& view, const Seen& seen,
                                    const std::array<std::uint32_t, 3>& triangle, const Vec3f& weights) {
  const PictureState& state = view.state;
  const render::Raster& raster = view.drawn.raster;
  const Vec3f at = between(view.points_mm, triangle, weights);
  const Vec3f normal = render::normalized(between(view.normals, triangle, weights));
  double share = 0, depth = 0, x = 0, y = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto b = static_cast<double>(weights[i]);
    const render::ScreenPoint& corner = view.drawn.screen[triangle[i]];
    share += b * (state.seen.empty() ? 1.0 : static_cast<double>(state.seen[triangle[i]]));
    depth += b * corner.depth_mm;
    x += b * corner.x_px;
    y += b * corner.y_px;
  }
  const Vec3f ray = render::normalized({seen.eye[0] - at[0], seen.eye[1] - at[1], seen.eye[2] - at[2]});
  if (render::dot(normal, ray) < least_facing) return std::nullopt;
  const long px = std::lround(x), py = std::lround(y);
  if (px < 0 || py < 0 || px >= raster.width_px || py >= raster.height_px) return std::nullopt;
  const float inverse = raster.inverse_depth_per_mm[raster.index(static_cast<int>(px), static_cast<int>(py))];
  if (inverse > 0 && depth > 1.0 / static_cast<double>(inverse) + depth_slack_mm / view.level.factor)
    return std::nullopt;
  const Vec3f shown = colour_at(view.level, x, y);
  const std::array<double, 3> lit = lit_of(state.light, {shown[0], shown[1], shown[2]});
  const double cosine = share * static_cast<double>(render::dot(normal, seen.towards));
  double mirrored = 0;
  if (cosine > 0) {
    const Vec3f halfway =
        render::normalized({seen.towards[0] + ray[0], seen.towards[1] + ray[1], seen.towards[2] + ray[2]});
    const Lobes lobes = lobes_at(static_cast<double>(render::dot(normal, halfway)));
    for (std::size_t k = 0; k < lobes.value.size(); ++k)
      mirrored += share * static_cast<double>(state.light.mirror[k]) * lobes.value[k];
  }
  Vec3f albedo;
  for (std::size_t c = 0; c < 3; ++c) {
    const double strength = light_at(state.light, c, cosine);
    if (strength < darkest_light) return std::nullopt;
    const double scattered = lit[c] - mirrored * static_cast<double>(state.light.parallel[c]);
    albedo[c] = static_cast<float>(std::max(least_albedo, scattered / strength));
  }
  return albedo;
}

// The reflectance of what the picture shows at a place in the head's frame.
std::optional<Vec3f> reflectance_seen_at(const StartView& view, const Seen& seen, const Vec3f& at) {
  const PoseView there = model::view(scaled(view.state.pose, view.level.factor), at);
  const render::Raster& raster = view.drawn.raster;
  const long px = std::lround(there.x_px), py = std::lround(there.y_px);
  if (px < 0 || py < 0 || px >= raster.width_px || py >= raster.height_px) return std::nullopt;
  const std::int32_t found = raster.triangles[raster.index(static_cast<int>(px), static_cast<int>(py))];
  if (found < 0) return std::nullopt;
  const std::array<std::uint32_t, 3>& triangle = view.triangles[static_cast<std::size_t>(found)];
  return reflectance_at(view, seen, triangle,
                        render::barycentrics_at(view.drawn.screen, triangle, static_cast<float>(there.x_px),
                                                static_cast<float>(there.y_px)));
}

}  // namespace

StartView start_view(const SkinBasis& basis, const std::vector<double>& identity, const PictureState& state,
                     PictureLevel level) {
  StartView result;
  result.state = state;
  result.points_mm = posed_skin(basis, identity, state.expression);
  result.normals = render::vertex_normals(result.points_mm, basis.triangles);
  result.level = std::move(level);
  result.triangles = basis.triangles;
  result.drawn = draw_skin(basis, result.points_mm, state.pose, result.level);
  return result;
}

void colour_points(const StartView& view, const SkinBasis& basis, const LipRims& rims, std::vector<SkinPoint>& points) {
  const PictureState& state = view.state;
  Seen seen{{}, camera_of(state.pose).position_mm};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t row = 0; row < 3; ++row)
      seen.towards[k] += static_cast<float>(state.pose.rotation[3 * row + k]) * state.light.direction[row];
  for (SkinPoint& point : points) {
    const auto& triangle = basis.triangles[point.triangle];
    std::optional<Vec3f> colour = reflectance_at(view, seen, triangle, point.weights);
    float outwards_mm = 0, parted = 0;
    for (std::size_t i = 0; i < 3 && !rims.parted.empty(); ++i) {
      outwards_mm += point.weights[i] * rims.outwards_mm[triangle[i]];
      parted += point.weights[i] * rims.parted[triangle[i]];
    }
    if (parted > 0) {
      Vec3f at = between(view.points_mm, triangle, point.weights);
      at[1] += outwards_mm;
      const std::optional<Vec3f> lip = reflectance_seen_at(view, seen, at);
      if (lip && !colour && parted > 0.5f) colour = lip;
      if (lip && colour)
        for (std::size_t c = 0; c < 3; ++c) (*colour)[c] += parted * ((*lip)[c] - (*colour)[c]);
    }
    point.mirrors = colour.has_value();
    if (colour) point.albedo = colour;
  }
}

}  // namespace face::model
