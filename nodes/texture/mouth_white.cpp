// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/mouth_white.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "nodes/base/quantile.h"
#include "nodes/model/light_model.h"
#include "nodes/render/shade.h"
#include "nodes/texture/draw_face.h"
#include "nodes/texture/texel_colour.h"

namespace face::texture {
namespace {

// Of teeth over the skin about the mouth, sRGB values: two GRID speakers' and the astronaut's come to 0.96, 1.07, 1.2.
constexpr double over_skin = 1.07;
constexpr float beside_mouth_mm[] = {25, 50};  // from its middle to that skin
constexpr float faces_forward = 0.6f;          // z of that skin's normals
constexpr float drawn_at_all = 0.5f;           // of drawn_share: neither eyes nor neck

}  // namespace

MouthWhite mouth_white(const Rig& person, const AlbedoMap& map, const model::SkinAtlas& atlas, const PosedFace& face,
                       const FaceLight& light) {
  const std::vector<Vec3f>& points = person.neutral.points_mm;
  const bool marked = person.landmarks68.size() == 68;
  Vec3f mouth{};
  for (std::size_t i = 60; marked && i < 68; ++i)
    for (std::size_t k = 0; k < 3; ++k) mouth[k] += points[person.landmarks68[i]][k] / 8;
  const std::vector<float> share = drawn_share(person);
  std::array<std::vector<double>, 3> skin;
  std::vector<double> facing;  // the parallel light
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t) {
    const std::uint32_t v = atlas.triangles[t][0];
    if (share[v] < drawn_at_all || render::normalized(face.normals[v])[2] < faces_forward) continue;
    if (marked) {
      const Vec3f apart = {points[v][0] - mouth[0], points[v][1] - mouth[1], points[v][2] - mouth[2]};
      const float squared = render::dot(apart, apart);
      if (squared < beside_mouth_mm[0] * beside_mouth_mm[0] || squared > beside_mouth_mm[1] * beside_mouth_mm[1])
        continue;
    }
    const Vec2f& uv = atlas.uvs[atlas.corners[t][0]];
    const Vec3f colour = colour_at(map, uv);
    if (colour[0] <= 0) continue;
    facing.push_back(static_cast<double>(face.parallel[v]));
    std::array<double, 3> lit{};
    for (std::size_t c = 0; c < 3; ++c) lit[c] = model::light_at(light, c, facing.back()) * colour[c];
    const std::array<double, 3> shown = model::shown(light, lit);
    for (std::size_t c = 0; c < 3; ++c) skin[c].push_back(shown[c]);
  }
  MouthWhite white;
  double grey = 0, parallel = 0, all = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    white.colour[c] = skin[c].empty() ? 1.0 : median(skin[c]);
    grey += model::luma[c] * white.colour[c];
    parallel += model::luma[c] * static_cast<double>(light.parallel[c]);
    all += model::luma[c] * model::light_at(light, c, median(facing));
  }
  if (all > 0) white.parallel = std::max(0.0, parallel / all);
  for (double& value : white.colour) value = std::clamp(over_skin * 0.5 * (value + grey), 0.0, 1.0);
  return white;
}

}  // namespace face::texture
