// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/scanner_view.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/render/camera.h"
#include "nodes/render/shade.h"

namespace face::phantom {
namespace {

render::RasterOptions raster_options(PictureSize size) {
  render::RasterOptions options;
  options.width_px = size.width_px;
  options.height_px = size.height_px;
  options.culling = render::Culling::none;
  return options;
}

Vec3f towards(const Vec3f& from, const Vec3f& to) {
  return render::normalized({to[0] - from[0], to[1] - from[1], to[2] - from[2]});
}

Vec3f mixed(const Vec3f& b, const render::Triangle& t, const std::vector<Vec3f>& values) {
  const Vec3f &p = values[t[0]], &q = values[t[1]], &r = values[t[2]];
  return {b[0] * p[0] + b[1] * q[0] + b[2] * r[0], b[0] * p[1] + b[1] * q[1] + b[2] * r[1],
          b[0] * p[2] + b[1] * q[2] + b[2] * r[2]};
}

}  // namespace

bool is_seen(const render::Raster& raster, const render::ScreenPoint& at, float tolerance_mm) {
  if (!(at.depth_mm > 0 && at.x_px >= 0 && at.y_px >= 0 && at.x_px <= static_cast<float>(raster.width_px - 1) &&
        at.y_px <= static_cast<float>(raster.height_px - 1)))
    return false;
  const int x = static_cast<int>(at.x_px), y = static_cast<int>(at.y_px);
  const int right = std::min(x + 1, raster.width_px - 1), below = std::min(y + 1, raster.height_px - 1);
  const auto& inverse = raster.inverse_depth_per_mm;
  float farthest = 0;
  for (const std::size_t i :
       {raster.index(x, y), raster.index(right, y), raster.index(x, below), raster.index(right, below)})
    if (inverse[i] > 0) farthest = std::max(farthest, 1 / inverse[i]);
  return farthest == 0 || at.depth_mm <= farthest + tolerance_mm;
}

ScannerView::ScannerView(const Rig& rig, const OpaqueTriangles& opaque, const Moment& moment, const Camera& camera,
                         PictureSize picture, const Camera& projector, PictureSize pattern, const SurfaceDots* dots,
                         const VertexMask* lost)
    : opaque_(opaque),
      lost_(lost),
      points_mm_(pose_points(rig, moment.weights)),
      normals_(render::vertex_normals(points_mm_, opaque.mesh.triangles)),
      mouth_(render::mouth_light(rig, points_mm_)),
      camera_(camera_in_head(camera, &moment.world_from_head)),
      projector_(camera_in_head(projector, &moment.world_from_head)),
      dots_(dots, points_mm_, opaque.mesh, ColourSpace::linear) {
  const Mesh& mesh = rig.neutral;
  check(mesh.colors_srgb.empty() || mesh.colors_srgb.size() == mesh.points_mm.size(), "the rig has ",
        mesh.colors_srgb.size(), " vertex colours, but ", mesh.points_mm.size(), " vertices");
  check(lost == nullptr || lost->on.size() == mesh.points_mm.size(), "the lost mask has ",
        lost == nullptr ? 0 : lost->on.size(), " vertices, but the rig ", mesh.points_mm.size());
  const render::SrgbTable srgb;
  albedo_.assign(points_mm_.size(), Vec3f{1, 1, 1});
  for (std::size_t v = 0; v < mesh.colors_srgb.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) albedo_[v][c] = srgb.linear(mesh.colors_srgb[v][c]);
  for (const Part& part : mesh.parts)
    part_albedo_.push_back(
        {srgb.linear(part.albedo_srgb[0]), srgb.linear(part.albedo_srgb[1]), srgb.linear(part.albedo_srgb[2])});
  if (part_albedo_.empty()) part_albedo_.push_back({1, 1, 1});
  screen_ = render::project(camera_, points_mm_);
  raster_ = render::rasterize(screen_, opaque.mesh.triangles, raster_options(picture));
  pattern_ = render::rasterize(render::project(projector_, points_mm_), opaque.mesh.triangles, raster_options(pattern));
}

bool ScannerView::is_lit(const render::ScreenPoint& at) const { return is_seen(pattern_, at, 0.3f); }

void ScannerView::rasterize_band(int top, int bottom, int samples, render::Raster& fine) const {
  const auto factor = static_cast<float>(samples);
  std::vector<render::ScreenPoint> screen = screen_;
  for (render::ScreenPoint& point : screen) {
    point.x_px = factor * (point.x_px + 0.5f) - 0.5f;
    point.y_px = factor * (point.y_px - static_cast<float>(top) + 0.5f) - 0.5f;
  }
  render::rasterize_into(screen, opaque_.mesh.triangles,
                         raster_options({raster_.width_px * samples, (bottom - top) * samples}), fine);
}

bool ScannerView::see(std::int32_t nearest, float x_px, float y_px, SeenPoint& seen) const {
  if (nearest < 0) return false;
  const auto t = static_cast<std::size_t>(nearest);
  const render::Triangle& triangle = opaque_.mesh.triangles[t];
  const std::uint16_t part = opaque_.mesh.parts[t];
  const Vec3f b = render::barycentrics_at(screen_, triangle, x_px, y_px);
  const Vec3f point = mixed(b, triangle, points_mm_);
  Vec3f normal = render::normalized(mixed(b, triangle, normals_));
  float facing = render::dot(normal, towards(point, camera_.position_mm));
  if (facing < 0) {  // the inside of a surface, or an interpolated normal just behind a silhouette
    facing = -facing;
    normal = {-normal[0], -normal[1], -normal[2]};
  }
  // Depth by the vertices' own and not by 1 / depth of the raster, whose vertices are snapped to 1/256 pixel.
  seen.depth_mm = b[0] * screen_[triangle[0]].depth_mm + b[1] * screen_[triangle[1]].depth_mm +
                  b[2] * screen_[triangle[2]].depth_mm;
  seen.camera_cosine = facing;
  seen.projector_cosine = render::dot(normal, towards(point, projector_.position_mm));
  seen.albedo = mixed(b, triangle, albedo_);
  for (std::size_t c = 0; c < 3; ++c) seen.albedo[c] *= part_albedo_[part][c];
  dots_.paint(point, part, seen.albedo);
  const render::ScreenPoint lit_at = render::project(projector_, point);
  seen.projector_x_px = lit_at.x_px;
  seen.lit = is_lit(lit_at);
  seen.ambient =
      b[0] * mouth_.exposure[triangle[0]] + b[1] * mouth_.exposure[triangle[1]] + b[2] * mouth_.exposure[triangle[2]];
  seen.lost = lost_ == nullptr
                  ? 0.0f
                  : b[0] * lost_->on[triangle[0]] + b[1] * lost_->on[triangle[1]] + b[2] * lost_->on[triangle[2]];
  return true;
}

std::vector<float> inverse_depths(const Rig& rig, const OpaqueTriangles& opaque, const Moment& moment,
                                  const Camera& camera, PictureSize picture) {
  const Camera view = camera_in_head(camera, &moment.world_from_head);
  return render::rasterize(render::project(view, pose_points(rig, moment.weights)), opaque.mesh.triangles,
                           raster_options(picture))
      .inverse_depth_per_mm;
}

}  // namespace face::phantom
