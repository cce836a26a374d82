// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/nostril_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "nodes/model/skin_atlas.h"
#include "nodes/model/skin_modes.h"
#include "nodes/phantom/cast_shadow.h"
#include "nodes/render/shade.h"

namespace face::texture {
namespace {

constexpr float reach_mm = 22;                // from the marks under the nose
constexpr float edge_mm = 0.5;                // of a shadow
constexpr float darkest = 0.05f;              // deep inside
constexpr float closed = 0.1f, open = 0.35f;  // share of the light from before and below that arrives: dark, as skin
constexpr std::array<Vec3f, 12> directions = {{{0, 0, 1},
                                               {0.5f, 0, 0.866f},
                                               {-0.5f, 0, 0.866f},
                                               {0, 0.5f, 0.866f},
                                               {0, -0.5f, 0.866f},
                                               {0.5f, -0.5f, 0.7071f},
                                               {-0.5f, -0.5f, 0.7071f},
                                               {0, -0.866f, 0.5f},
                                               {0.6f, -0.7f, 0.3873f},
                                               {-0.6f, -0.7f, 0.3873f},
                                               {0.866f, 0, 0.5f},
                                               {-0.866f, 0, 0.5f}}};

}  // namespace

std::vector<float> nostril_shade(const MorphableModel& model) {
  const std::vector<Vec3f>& points = model.mean.points_mm;
  std::vector<float> shade(points.size(), 1.0f);
  if (model.landmarks68.size() != 68) return shade;
  const std::vector<bool> is_skin = model::skin_vertices(model.mean);
  std::vector<bool> is_near(points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t i = 31; i < 36; ++i) {
      const Vec3f& mark = points[model.landmarks68[i]];
      const Vec3f apart = {points[v][0] - mark[0], points[v][1] - mark[1], points[v][2] - mark[2]};
      is_near[v] = is_near[v] || (is_skin[v] && render::dot(apart, apart) < reach_mm * reach_mm);
    }
  const std::vector<render::Triangle> skin = model::make_skin_atlas(model.mean).triangles;
  const std::vector<Vec3f> normals = render::vertex_normals(points, skin);
  std::vector<float> arrives(points.size(), 0.0f);
  for (const Vec3f& direction : directions) {
    const std::vector<float> lit = phantom::cast_shadow(points, normals, skin, direction, edge_mm);
    for (std::size_t v = 0; v < points.size(); ++v) arrives[v] += lit[v] / static_cast<float>(directions.size());
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!is_near[v]) continue;
    shade[v] = darkest + (1 - darkest) * std::clamp((arrives[v] - closed) / (open - closed), 0.0f, 1.0f);
  }
  return shade;
}

}  // namespace face::texture
