// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/render_head.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "nodes/base/check.h"
#include "nodes/base/pose.h"
#include "nodes/render/rasterize.h"
#include "nodes/render/shade.h"
#include "nodes/render/triangulate.h"

namespace face::render {
namespace {

struct Bounds {
  Vec3f low = {0, 0, 0};
  Vec3f high = {0, 0, 0};
  bool empty = true;

  void add(const Vec3f& p) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = empty ? p[i] : std::min(low[i], p[i]);
      high[i] = empty ? p[i] : std::max(high[i], p[i]);
    }
    empty = false;
  }
};

// The box of the part named "face", or of everything visible in a rig without one.
Bounds face_bounds(const Mesh& mesh) {
  const bool named = std::any_of(mesh.parts.begin(), mesh.parts.end(), [](const Part& p) { return p.name == "face"; });
  Bounds bounds;
  const auto add_polygons = [&](std::size_t first, std::size_t count) {
    for (std::size_t c = mesh.polygon_starts[first]; c < mesh.polygon_starts[first + count]; ++c)
      bounds.add(mesh.points_mm[mesh.corners[c]]);
  };
  for (const Part& part : mesh.parts)
    if (named ? part.name == "face" : part.visible) add_polygons(part.first_polygon, part.polygon_count);
  if (mesh.parts.empty()) add_polygons(0, mesh.polygon_count());
  return bounds;
}

bool is_skin(const std::string& part) { return part == "face" || part == "head"; }

// What does not change from pixel to pixel.
struct Scene {
  std::vector<Vec3f> points_mm;
  std::vector<Vec3f> normals;
  std::vector<Vec3f> albedo;  // per vertex, linear; empty = 1
  std::vector<ScreenPoint> screen;
  Triangulation mesh;
  struct Material {
    Vec3f albedo;
    float gloss;
    float scatter;
  };
  std::vector<Material> materials;  // per part
  Vec3f eye_mm;
};

Vec3f shade_sample(const Scene& scene, std::int32_t triangle_index, int x, int y) {
  const auto t = static_cast<std::size_t>(triangle_index);
  const Triangle& triangle = scene.mesh.triangles[t];
  const Scene::Material& material = scene.materials[scene.mesh.parts[t]];
  const Vec3f b = barycentrics_at(scene.screen, triangle, static_cast<float>(x), static_cast<float>(y));
  const auto mix = [&](const std::vector<Vec3f>& values) {
    const Vec3f &p = values[triangle[0]], &q = values[triangle[1]], &r = values[triangle[2]];
    return Vec3f{b[0] * p[0] + b[1] * q[0] + b[2] * r[0], b[0] * p[1] + b[1] * q[1] + b[2] * r[1],
                 b[0] * p[2] + b[1] * q[2] + b[2] * r[2]};
  };
  Surface surface;
  surface.position_mm = mix(scene.points_mm);
  surface.normal = mix(scene.normals);
  surface.albedo = material.albedo;
  if (!scene.albedo.empty()) {
    const Vec3f tint = mix(scene.albedo);
    for (std::size_t c = 0; c < 3; ++c) surface.albedo[c] *= tint[c];
  }
  surface.gloss = material.gloss;
  surface.scatter = material.scatter;
  return shade(surface, scene.eye_mm);
}

// Samples that see the same part at nearly the same depth differ by little: they are shaded once, at the first one.
bool alike(const Scene& scene, const Raster& raster, int x, int y, int n) {
  const std::size_t first = raster.index(x, y);
  if (raster.triangles[first] < 0) return false;
  const std::uint16_t part = scene.mesh.parts[static_cast<std::size_t>(raster.triangles[first])];
  const float depth = raster.inverse_depth_per_mm[first];
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::size_t sample = raster.index(x + i, y + j);
      const std::int32_t triangle = raster.triangles[sample];
      if (triangle < 0 || scene.mesh.parts[static_cast<std::size_t>(triangle)] != part) return false;
      if (std::abs(raster.inverse_depth_per_mm[sample] - depth) > 0.002f * depth) return false;
    }
  return true;
}

Image resolve(const Scene& scene, const Raster& raster, const SrgbTable& srgb, const RenderHeadOptions& options) {
  const int n = options.samples;
  const Vec3f background = {srgb.linear(static_cast<float>(options.background_red)),
                            srgb.linear(static_cast<float>(options.background_green)),
                            srgb.linear(static_cast<float>(options.background_blue))};
  Image image{options.width_px, options.height_px, 3, {}};
  image.pixels.resize(static_cast<std::size_t>(options.width_px) * static_cast<std::size_t>(options.height_px) * 3);
  std::uint8_t* out = image.pixels.data();
  for (int y = 0; y < options.height_px; ++y)
    for (int x = 0; x < options.width_px; ++x, out += 3) {
      Vec3f sum = {0, 0, 0};
      const bool once = alike(scene, raster, x * n, y * n, n);
      const int count = once ? 1 : n;
      for (int j = 0; j < count; ++j)
        for (int i = 0; i < count; ++i) {
          const int sx = x * n + i, sy = y * n + j;
          const std::int32_t triangle = raster.triangles[raster.index(sx, sy)];
          const Vec3f colour = triangle < 0 ? background : shade_sample(scene, triangle, sx, sy);
          // Clamped before the mean: an overbright sample must not bleed over an edge.
          for (std::size_t c = 0; c < 3; ++c) sum[c] += std::min(1.0f, colour[c]);
        }
      const float scale = 1.0f / static_cast<float>(count * count);
      for (std::size_t c = 0; c < 3; ++c) out[c] = srgb.encoded(sum[c] * scale);
    }
  return image;
}

}  // namespace

Camera head_camera(const Rig& rig, const RenderHeadOptions& options) {
  const Bounds bounds = face_bounds(rig.neutral);
  check(!bounds.empty, "the rig has no visible polygon to render");
  Vec3f centre;
  for (std::size_t i = 0; i < 3; ++i) centre[i] = 0.5f * (bounds.low[i] + bounds.high[i]);
  double distance = options.distance_mm;
  if (distance == 0) {
    const double half_tan = std::tan(0.5 * options.field_of_view_deg * std::numbers::pi / 180.0);
    const double aspect = static_cast<double>(options.width_px) / options.height_px;
    const double extent = std::max(bounds.high[1] - bounds.low[1], (bounds.high[0] - bounds.low[0]) / static_cast<float>(aspect));
    distance = 0.5 * 1.15 * extent / half_tan + 0.5 * (bounds.high[2] - bounds.low[2]);
  }
  return orbit_camera(centre, static_cast<float>(distance), static_cast<float>(options.yaw_deg),
                      static_cast<float>(options.pitch_deg), static_cast<float>(options.field_of_view_deg),
                      options.width_px, options.height_px);
}

Image render_head(const Rig& rig, const Weights& weights, const RenderHeadOptions& options) {
  check(options.samples >= 1, "samples is ", options.samples, ", expected at least 1");
  check(options.width_px > 0 && options.height_px > 0, "the picture is ", options.width_px, " x ", options.height_px,
        " pixels, expected at least 1 x 1");
  const Mesh& neutral = rig.neutral;
  check(neutral.colors_srgb.empty() || neutral.colors_srgb.size() == neutral.points_mm.size(), "the rig has ",
        neutral.colors_srgb.size(), " vertex colours, but ", neutral.points_mm.size(), " vertices");
  const SrgbTable srgb;
  Scene scene;
  scene.points_mm = pose_points(rig, weights);
  scene.mesh = triangulate(neutral);
  scene.normals = vertex_normals(scene.points_mm, scene.mesh.triangles);
  scene.albedo.resize(neutral.colors_srgb.size());
  for (std::size_t v = 0; v < scene.albedo.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) scene.albedo[v][c] = srgb.linear(neutral.colors_srgb[v][c]);
  for (const Part& part : neutral.parts) {
    Scene::Material material{part.albedo_srgb, part.gloss, is_skin(part.name) ? 1.0f : 0.0f};
    for (float& channel : material.albedo) channel = srgb.linear(channel);
    scene.materials.push_back(material);
  }
  if (scene.materials.empty()) scene.materials.push_back({{0.6f, 0.6f, 0.6f}, 0.2f, 0.0f});
  const Camera camera = supersampled(head_camera(rig, options), options.samples);
  scene.eye_mm = camera.position_mm;
  scene.screen = project(camera, scene.points_mm);
  RasterOptions raster_options;
  raster_options.width_px = options.width_px * options.samples;
  raster_options.height_px = options.height_px * options.samples;
  raster_options.culling = Culling::none;
  return resolve(scene, rasterize(scene.screen, scene.mesh.triangles, raster_options), srgb, options);
}

}  // namespace face::render
