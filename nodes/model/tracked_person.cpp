// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/tracked_person.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nodes/model/pose_model.h"
#include "nodes/model/skin_atlas.h"

namespace face::model {
namespace {

// Lids that shut bring skin to light which the first frame did not show, and turned the head by up to 1.6 degrees: what
// lies within an ellipse about the corners of an eye is not compared.
constexpr double eye_width = 1.4, eye_height_share = 0.8;  // of the distance of the corners; of the width

// The map's colour at every vertex of the basis.
std::vector<Vec3f> vertex_colours(const MorphableModel& model, const SkinBasis& basis, const AlbedoMap& map) {
  std::vector<Vec3f> all = model.mean_albedo;
  const SkinAtlas atlas = make_skin_atlas(model.mean);
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2f& uv = atlas.uvs[atlas.corners[t][i]];
      const int x = std::clamp(static_cast<int>(uv[0] * static_cast<float>(map.width)), 0, map.width - 1);
      const int y = std::clamp(static_cast<int>((1 - uv[1]) * static_cast<float>(map.height)), 0, map.height - 1);
      const Vec3f& colour =
          map.albedo[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)];
      if (colour[0] > 0) all[atlas.triangles[t][i]] = colour;
    }
  std::vector<Vec3f> colours;
  colours.reserve(basis.vertices.size());
  for (const std::uint32_t v : basis.vertices) colours.push_back(all[v]);
  return colours;
}

// The basis without the triangles about the eyes.
SkinBasis without_lids(const MorphableModel& model, SkinBasis basis) {
  if (model.landmarks68.size() != 68) return basis;
  std::vector<bool> is_lid(basis.vertices.size());
  for (const std::array<std::size_t, 2>& corners : {std::array<std::size_t, 2>{36, 39}, {42, 45}}) {
    const Vec3f &a = model.mean.points_mm[model.landmarks68[corners[0]]],
                &b = model.mean.points_mm[model.landmarks68[corners[1]]];
    const float half = 0.5f * static_cast<float>(eye_width) * std::abs(a[0] - b[0]);
    for (std::size_t v = 0; v < is_lid.size(); ++v) {
      const float x = (basis.mean_mm[v][0] - 0.5f * (a[0] + b[0])) / half;
      const float y = (basis.mean_mm[v][1] - 0.5f * (a[1] + b[1])) / (static_cast<float>(eye_height_share) * half);
      if (x * x + y * y < 1) is_lid[v] = true;
    }
  }
  std::erase_if(basis.triangles, [&](const auto& t) { return is_lid[t[0]] || is_lid[t[1]] || is_lid[t[2]]; });
  return basis;
}

}  // namespace

TrackedPerson tracked_person(const MorphableModel& model, const FaceFit& start, const AlbedoMap& albedo,
                             std::size_t expressions) {
  SkinBasis skin = make_skin_basis(model, 0, expressions, 0);
  const std::vector<Vec3f> rest_mm = pose_model(model, start.identity, {});
  SkinBasis lidless = without_lids(model, skin);
  for (std::size_t v = 0; v < skin.vertices.size(); ++v)
    skin.mean_mm[v] = lidless.mean_mm[v] = rest_mm[skin.vertices[v]];
  PictureState first;
  first.pose = pose_of(start.camera, turning_point(model));
  first.expression = expression_of(start, skin.expressions);
  first.light = start.light;
  std::vector<Vec3f> colours = vertex_colours(model, lidless, albedo);
  PartingLips lips(model, lidless, first.expression);
  return {std::move(skin),  std::move(lidless),  std::move(colours),
          std::move(first), lip_gap_rows(model), std::move(lips)};
}

std::vector<double> expression_of(const FaceFit& fit, std::size_t expressions) {
  std::vector<double> leading(
      fit.expression.begin(),
      fit.expression.begin() + static_cast<std::ptrdiff_t>(std::min(expressions, fit.expression.size())));
  leading.resize(expressions, 0.0);
  return leading;
}

}  // namespace face::model
