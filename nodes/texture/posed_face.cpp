// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/posed_face.h"

#include <algorithm>
#include <string_view>

#include "nodes/phantom/cast_shadow.h"
#include "nodes/render/camera.h"

namespace face::texture {
namespace {

constexpr float shadow_edge_mm = 4;  // as in model.fit_image

bool hides(const Part& part) {
  return part.visible && part.name != "hair" && part.name != "brows" && part.name.find("lash") == std::string::npos;
}

}  // namespace

PosedFace pose_face(const Mesh& mesh, std::vector<Vec3f> points_mm, const FaceFit& fit, int factor) {
  PosedFace face;
  face.points_mm = std::move(points_mm);
  const render::Triangulation all = render::triangulate(mesh);
  std::vector<render::Triangle> skin_triangles;
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    const bool whole = mesh.parts.empty();
    if (!whole && !hides(mesh.parts[all.parts[t]])) continue;
    face.solid.triangles.push_back(all.triangles[t]);
    face.solid.polygons.push_back(all.polygons[t]);
    face.solid.parts.push_back(all.parts[t]);
    face.skin.push_back(whole || mesh.parts[all.parts[t]].name == "face");
    if (face.skin.back()) skin_triangles.push_back(all.triangles[t]);
  }
  face.normals = render::vertex_normals(face.points_mm, face.solid.triangles);
  Vec3f light{};  // in the head's frame
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t row = 0; row < 3; ++row)
      light[k] += fit.camera.cam_from_world[3 * row + k] * fit.light.direction[row];
  face.parallel = phantom::cast_shadow(face.points_mm, face.normals, skin_triangles, light, shadow_edge_mm);
  for (std::size_t v = 0; v < face.parallel.size(); ++v) {
    const Vec3f& n = face.normals[v];
    face.parallel[v] *= std::max(0.0f, n[0] * light[0] + n[1] * light[1] + n[2] * light[2]);
  }
  face.screen = render::project(render::supersampled(fit.camera, factor), face.points_mm);
  render::RasterOptions options;
  options.width_px = fit.image_width_px * factor;
  options.height_px = fit.image_height_px * factor;
  face.raster = render::rasterize(face.screen, face.solid.triangles, options);
  return face;
}

}  // namespace face::texture
