// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/neutralise.h"

#include <algorithm>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/model/light_model.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/skin_atlas.h"
#include "nodes/render/shade.h"

namespace face::texture {

Rig neutralise(const MorphableModel& model, const Rig& rig, const FaceFit& fit, const AlbedoMap& albedo) {
  check(rig.neutral.points_mm.size() == model.mean.points_mm.size(), "the rig has ", rig.neutral.points_mm.size(),
        " vertices, the model ", model.mean.points_mm.size());
  check(albedo.width > 0 && albedo.height > 0 &&
            albedo.albedo.size() == static_cast<std::size_t>(albedo.width) * static_cast<std::size_t>(albedo.height),
        "albedo has ", albedo.albedo.size(), " texels, expected ", albedo.width, " x ", albedo.height);
  Rig person = rig;
  person.neutral.points_mm = model::pose_model(model, fit.identity, {});
  Mesh& mesh = person.neutral;
  if (mesh.colors_srgb.size() != mesh.points_mm.size()) mesh.colors_srgb.assign(mesh.points_mm.size(), Vec3f{1, 1, 1});
  const render::SrgbTable srgb;
  std::vector<Vec3f> part_albedo(mesh.points_mm.size(), Vec3f{1, 1, 1});
  for (const Part& part : mesh.parts)
    for (std::size_t c = mesh.polygon_starts[part.first_polygon];
         c < mesh.polygon_starts[part.first_polygon + part.polygon_count]; ++c)
      for (std::size_t k = 0; k < 3; ++k) part_albedo[mesh.corners[c]][k] = srgb.linear(part.albedo_srgb[k]);
  const model::SkinAtlas atlas = model::make_skin_atlas(mesh);
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = atlas.triangles[t][i];
      const Vec2f& uv = atlas.uvs[atlas.corners[t][i]];
      const int x = std::clamp(static_cast<int>(uv[0] * static_cast<float>(albedo.width)), 0, albedo.width - 1);
      const int y = std::clamp(static_cast<int>((1 - uv[1]) * static_cast<float>(albedo.height)), 0, albedo.height - 1);
      const Vec3f& colour = albedo.albedo[static_cast<std::size_t>(y) * static_cast<std::size_t>(albedo.width) +
                                          static_cast<std::size_t>(x)];
      if (colour[0] <= 0) continue;
      for (std::size_t c = 0; c < 3; ++c)
        mesh.colors_srgb[v][c] = static_cast<float>(
            std::clamp(srgb_of(std::min(1.0f, colour[c] / std::max(0.02f, part_albedo[v][c]))), 0.0, 1.0));
    }
  return person;
}

}  // namespace face::texture
