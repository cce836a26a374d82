// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "nodes/base/pose.h"

namespace face::render {
namespace {

constexpr float lash_reach_mm = 8;  // longer than a lash

bool is_skin(const std::string& part) { return part == "face" || part == "head" || part == "ears" || part == "neck"; }
bool is_lash(const std::string& part) { return part.find("lash") != std::string::npos; }

// Moves the triangles of lash parts to their own list.
void split_lashes(const Mesh& mesh, Triangulation& all, Triangulation& lashes) {
  if (std::none_of(mesh.parts.begin(), mesh.parts.end(), [](const Part& p) { return p.visible && is_lash(p.name); }))
    return;
  Triangulation rest;
  rest.triangles.reserve(all.triangles.size());
  rest.polygons.reserve(all.triangles.size());
  rest.parts.reserve(all.triangles.size());
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    Triangulation& target = is_lash(mesh.parts[all.parts[t]].name) ? lashes : rest;
    target.triangles.push_back(all.triangles[t]);
    target.polygons.push_back(all.polygons[t]);
    target.parts.push_back(all.parts[t]);
  }
  all = std::move(rest);
}

// Lashes thin out from the lid to their tips: opacity falls with the distance to the nearest vertex of the skin.
void thin_out_lashes(const Mesh& mesh, Scene& scene) {
  scene.opacity.assign(mesh.points_mm.size(), 1.0f);
  if (scene.lashes.triangles.empty()) return;
  std::vector<bool> in_lashes(mesh.points_mm.size(), false);
  float low_x = 1e9f, high_x = -1e9f, low_y = 1e9f, high_y = -1e9f;
  for (const Triangle& t : scene.lashes.triangles)
    for (const std::uint32_t v : t) {
      in_lashes[v] = true;
      low_x = std::min(low_x, mesh.points_mm[v][0]);
      high_x = std::max(high_x, mesh.points_mm[v][0]);
      low_y = std::min(low_y, mesh.points_mm[v][1]);
      high_y = std::max(high_y, mesh.points_mm[v][1]);
    }
  // Skin vertices near the lashes, sorted by x for the search.
  std::vector<Vec3f> skin;
  std::vector<bool> seen(mesh.points_mm.size(), false);
  for (std::size_t t = 0; t < scene.opaque.triangles.size(); ++t) {
    if (mesh.parts[scene.opaque.parts[t]].name != "face") continue;
    for (const std::uint32_t v : scene.opaque.triangles[t]) {
      const Vec3f& p = mesh.points_mm[v];
      if (seen[v] || p[0] < low_x - lash_reach_mm || p[0] > high_x + lash_reach_mm || p[1] < low_y - lash_reach_mm ||
          p[1] > high_y + lash_reach_mm)
        continue;
      seen[v] = true;
      skin.push_back(p);
    }
  }
  std::sort(skin.begin(), skin.end());
  for (std::size_t v = 0; v < in_lashes.size(); ++v) {
    if (!in_lashes[v]) continue;
    const Vec3f& p = mesh.points_mm[v];
    float nearest = lash_reach_mm * lash_reach_mm;
    auto it = std::lower_bound(skin.begin(), skin.end(), Vec3f{p[0] - lash_reach_mm, -1e9f, -1e9f});
    for (; it != skin.end() && (*it)[0] < p[0] + lash_reach_mm; ++it) {
      const float dx = (*it)[0] - p[0], dy = (*it)[1] - p[1], dz = (*it)[2] - p[2];
      nearest = std::min(nearest, dx * dx + dy * dy + dz * dz);
    }
    scene.opacity[v] = 0.95f * (1.0f - std::sqrt(nearest) / lash_reach_mm);
  }
}

}  // namespace

Scene make_scene(const Rig& rig, const Weights& weights, const Camera& camera, const SrgbTable& srgb) {
  const Mesh& mesh = rig.neutral;
  Scene scene;
  scene.points_mm = pose_points(rig, weights);
  scene.opaque = triangulate(mesh);
  scene.normals = vertex_normals(scene.points_mm, scene.opaque.triangles);
  split_lashes(mesh, scene.opaque, scene.lashes);
  thin_out_lashes(mesh, scene);
  scene.tint.resize(mesh.colors_srgb.size());
  for (std::size_t v = 0; v < scene.tint.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) scene.tint[v][c] = srgb.linear(mesh.colors_srgb[v][c]);
  for (const Part& part : mesh.parts) {
    Scene::Material material{part.albedo_srgb, part.gloss, is_skin(part.name) ? 1.0f : 0.0f};
    for (float& channel : material.albedo) channel = srgb.linear(channel);
    scene.materials.push_back(material);
  }
  if (scene.materials.empty()) scene.materials.emplace_back();
  scene.mouth = mouth_light(rig, scene.points_mm);
  scene.exposure = std::move(scene.mouth.exposure);
  scene.screen = project(camera, scene.points_mm);
  scene.eye_mm = camera.position_mm;
  return scene;
}

void add_screen_occlusion(const Raster& raster, const Camera& camera, Scene& scene) {
  constexpr std::array<float, 3> radii_mm = {3.5f, 9.0f, 22.0f};
  constexpr float hidden_mm = 2.5f;  // a vertex this far behind what is seen is not seen...
  constexpr float crevice_mm = 35;   // ...and less than this far it is in a nostril or under the chin, and dark
  constexpr float bias = 0.12f;      // of the cosine: a plane or a sphere does not darken itself
  constexpr float strength = 2.6f;
  constexpr float darkest = 0.35f;
  // Directions of a hexagon, turned from ring to ring.
  constexpr float s = 0.8660254f;
  constexpr std::array<std::array<float, 2>, 12> directions = {{{1, 0},
                                                                {0.5f, s},
                                                                {-0.5f, s},
                                                                {-1, 0},
                                                                {-0.5f, -s},
                                                                {0.5f, -s},
                                                                {s, 0.5f},
                                                                {0, 1},
                                                                {-s, 0.5f},
                                                                {-s, -0.5f},
                                                                {0, -1},
                                                                {s, -0.5f}}};
  const std::array<float, 9>& r = camera.cam_from_world;
  for (std::size_t v = 0; v < scene.points_mm.size(); ++v) {
    if (scene.mouth.inside[v]) continue;  // dark already
    const ScreenPoint& at = scene.screen[v];
    const Vec3f& n = scene.normals[v];
    const Vec3f normal = {r[0] * n[0] + r[1] * n[1] + r[2] * n[2], r[3] * n[0] + r[4] * n[1] + r[5] * n[2],
                          r[6] * n[0] + r[7] * n[1] + r[8] * n[2]};
    if (normal[2] < -0.6f || !(at.depth_mm > 0)) continue;
    const auto seen = [&](float x, float y) {  // 1 / depth of what is seen there, 0 for nothing
      const int column = static_cast<int>(x + 0.5f), row = static_cast<int>(y + 0.5f);
      if (!(x >= 0 && y >= 0) || column >= raster.width_px || row >= raster.height_px) return 0.0f;
      return raster.inverse_depth_per_mm[raster.index(column, row)];
    };
    const float in_front = seen(at.x_px, at.y_px);
    const float behind_mm = in_front > 0 ? at.depth_mm - 1.0f / in_front : 0.0f;
    if (behind_mm > hidden_mm) {
      const float depth = std::min(1.0f, behind_mm / crevice_mm);
      scene.exposure[v] =
          1.0f - 2.2f * depth * (1.0f - depth);  // no jump where a vertex goes out of sight or out of reach
      continue;
    }
    if (normal[2] < -0.2f) continue;
    const float mm_per_px = at.depth_mm / camera.focal_px;
    float sum = 0;
    for (std::size_t ring = 0; ring < radii_mm.size(); ++ring) {
      const float radius_px = radii_mm[ring] / mm_per_px;
      for (std::size_t i = 0; i < 6; ++i) {
        const auto& direction = directions[(ring % 2) * 6 + i];
        const float x = at.x_px + radius_px * direction[0], y = at.y_px + radius_px * direction[1];
        const float inverse = seen(x, y);
        if (inverse == 0) continue;
        const float depth = 1.0f / inverse;
        const float scale = depth / camera.focal_px;
        const Vec3f d = {(x - camera.centre_x_px) * scale - (at.x_px - camera.centre_x_px) * mm_per_px,
                         (camera.centre_y_px - y) * scale - (camera.centre_y_px - at.y_px) * mm_per_px,
                         at.depth_mm - depth};
        const float squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        const float cosine = (d[0] * normal[0] + d[1] * normal[1] + d[2] * normal[2]) / std::sqrt(squared + 1e-6f);
        const float reach = radii_mm[ring] * radii_mm[ring];
        sum += std::max(0.0f, cosine - bias) * reach / (reach + 0.5f * squared);
      }
    }
    scene.exposure[v] = std::max(darkest, 1.0f - strength * sum / 18.0f);
  }
}

namespace {

// Light per unit of albedo inside the mouth. Deep inside it comes from the opening alone, whatever the lamps outside:
// no lamp shines on a molar from behind. Near the lips it goes over to that of the face.
Vec3f light_in_mouth(const Scene& scene, std::size_t v, const Vec3f& diffuse) {
  constexpr Vec3f in_front = {1.05f, 0.98f, 0.88f};  // what falls on the face, seen through the lips
  constexpr Vec3f reddened = {1.0f, 0.68f, 0.48f};   // of it, by lips, cheeks and gums on the way in
  const Vec3f& p = scene.points_mm[v];
  const Vec3f& o = scene.mouth.opening_mm;
  const float exposure = scene.exposure[v];
  const float cosine = dot(scene.normals[v], normalized({o[0] - p[0], o[1] - p[1], o[2] - p[2]}));
  const float facing = std::max(0.0f, 0.35f + 0.65f * cosine);  // wet and crowded: light wraps around
  const float back = 0.4f + 0.6f * std::min(1.0f, exposure / 0.3f);
  Vec3f light;
  for (std::size_t c = 0; c < 3; ++c) {
    const float through = in_front[c] * (reddened[c] + (1.0f - reddened[c]) * exposure * exposure) * facing;
    light[c] = exposure * (through + exposure * (diffuse[c] - through)) + back * scene.mouth.bounced[c];
  }
  return light;
}

}  // namespace

void light_scene(Scene& scene) {
  constexpr Vec3f darkest_flesh = {0.20f, 0.038f, 0.033f};  // linear; a throat painted black is still flesh
  // A vertex has the material of the last triangle that uses it: at the border of skin and mouth that is as good as
  // any.
  std::vector<std::uint16_t> material_of(scene.points_mm.size(), 0);
  for (const Triangulation* mesh : {&scene.opaque, &scene.lashes})
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
      for (const std::uint32_t v : mesh->triangles[t]) material_of[v] = mesh->parts[t];
  scene.looks.resize(scene.points_mm.size());
  for (std::size_t v = 0; v < scene.looks.size(); ++v) {
    const Vec3f& n = scene.normals[v];
    const Vec3f& p = scene.points_mm[v];
    const Scene::Material& material = scene.materials[material_of[v]];
    const Vec3f view = {scene.eye_mm[0] - p[0], scene.eye_mm[1] - p[1], scene.eye_mm[2] - p[2]};
    const Vec3f light = diffuse_light(n, material.scatter);
    Vec3f tint = scene.tint.empty() ? Vec3f{1, 1, 1} : scene.tint[v];
    const float exposure = scene.exposure[v];
    VertexLook& look = scene.looks[v];
    using Four = VertexLook::Four;
    look.normal = Four{n[0], n[1], n[2], scene.opacity[v]};
    const bool soft = material.gloss > 0 && material.gloss <= soft_gloss && dot(n, view) > 0;
    look.view_mm = Four{view[0], view[1], view[2], soft ? exposure * highlights(n, view, material.gloss)[1] : 0.0f};
    if (scene.mouth.inside[v]) {
      const Vec3f inner = light_in_mouth(scene, v, light);
      for (std::size_t c = 0; c < 3; ++c) tint[c] = std::max(tint[c], darkest_flesh[c]);
      look.light = Four{inner[0] * tint[0], inner[1] * tint[1], inner[2] * tint[2], exposure};
      continue;
    }
    // What little light there is in a crevice has been on skin before: it is warm.
    const float shadow = 1.0f - exposure;
    const Four warmth = {1.0f + 0.15f * shadow, 1.0f - 0.12f * shadow, 1.0f - 0.22f * shadow, 1.0f};
    look.light = Four{light[0] * tint[0], light[1] * tint[1], light[2] * tint[2], 1} * exposure * warmth;
  }
}

}  // namespace face::render
