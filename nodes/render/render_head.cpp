// SPDX-License-Identifier: Apache-2.0
#include "nodes/render/render_head.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/render/draw_lashes.h"
#include "nodes/render/rasterize.h"
#include "nodes/render/scene.h"
#include "nodes/render/shade.h"
#include "nodes/types/arkit.h"

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

constexpr double margin = 1.06;  // of the picture over the head

Bounds visible_bounds(const Mesh& mesh) {
  Bounds bounds;
  if (mesh.polygon_count() == 0) return bounds;
  const auto add_polygons = [&](std::size_t first, std::size_t count) {
    for (std::size_t c = mesh.polygon_starts[first]; c < mesh.polygon_starts[first + count]; ++c)
      bounds.add(mesh.points_mm[mesh.corners[c]]);
  };
  for (const Part& part : mesh.parts)
    if (part.visible) add_polygons(part.first_polygon, part.polygon_count);
  if (mesh.parts.empty()) add_polygons(0, mesh.polygon_count());
  return bounds;
}

// What ARKit's shapes move: the face, where a mesh is more than that.
Bounds moved_bounds(const Rig& rig) {
  Bounds bounds;
  for (std::size_t s = 0; s < std::min(rig.shapes.size(), std::size_t{arkit_count}); ++s)
    for (const std::uint32_t v : rig.shapes[s].vertices) bounds.add(rig.neutral.points_mm[v]);
  return bounds;
}

// The box to show: from the top of the head to a little below the chin, without the shoulders, or the face alone. The
// chin is landmark 8, or a quarter of the way down again below the lips, or the lowest that a shape of a whole person
// moves. The whole of a mesh that is a head without marks.
Bounds framed_bounds(const Rig& rig, Framing framing) {
  constexpr float face_of_person = 1.0f / 3;  // less of the height is moved by shapes: there is a body below
  Bounds bounds = visible_bounds(rig.neutral);
  const bool marked = rig.landmarks68.size() == 68 || !rig.inner_lips.empty();
  const Bounds moved = marked ? Bounds() : moved_bounds(rig);
  const bool has_body =
      !moved.empty && moved.high[1] - moved.low[1] < face_of_person * (bounds.high[1] - bounds.low[1]);
  if (bounds.empty || (!marked && !has_body)) return bounds;
  const std::vector<Vec3f>& points = rig.neutral.points_mm;
  float chin = 0, brows = bounds.low[1];
  Vec3f front = {0, 0, 0};
  if (rig.landmarks68.size() == 68) {
    chin = points[rig.landmarks68[8]][1];
    front = points[rig.landmarks68[30]];
    for (std::size_t i = 17; i < 27; ++i) brows = std::max(brows, points[rig.landmarks68[i]][1]);
  } else if (!marked) {
    front = {(moved.low[0] + moved.high[0]) / 2, moved.low[1], moved.high[2]};
    chin = moved.low[1];
  } else {
    front = points[rig.inner_lips[rig.inner_lips.size() / 2].lower];
    chin = front[1] - 0.25f * (bounds.high[1] - front[1]);
  }
  const float height = bounds.high[1] - chin;
  const float half_width = (framing == Framing::head ? 0.45f : 0.28f) * height;
  const float depth = (framing == Framing::head ? 0.8f : 0.35f) * height;
  bounds.low[1] = std::max(bounds.low[1], chin - (framing == Framing::head ? 0.15f : 0.06f) * height);
  if (framing == Framing::face) bounds.high[1] = std::max(chin + 0.58f * height, brows + 0.04f * height);
  bounds.low[0] = std::max(bounds.low[0], front[0] - half_width);
  bounds.high[0] = std::min(bounds.high[0], front[0] + half_width);
  bounds.high[2] = front[2];
  bounds.low[2] = front[2] - depth;
  return bounds;
}

struct Shaded {
  Vec3f colour;
  float opacity;
};

// screen: where the triangles were drawn; (x, y) in the same raster.
Shaded shade_sample(const Scene& scene, const Triangulation& mesh, const std::vector<ScreenPoint>& screen,
                    std::int32_t triangle_index, int x, int y) {
  const auto t = static_cast<std::size_t>(triangle_index);
  const Triangle& triangle = mesh.triangles[t];
  const Scene::Material& material = scene.materials[mesh.parts[t]];
  const Vec3f b = barycentrics_at(screen, triangle, static_cast<float>(x), static_cast<float>(y));
  const VertexLook &p = scene.looks[triangle[0]], &q = scene.looks[triangle[1]], &r = scene.looks[triangle[2]];
  const VertexLook::Four light = b[0] * p.light + b[1] * q.light + b[2] * r.light;
  const VertexLook::Four normal = b[0] * p.normal + b[1] * q.normal + b[2] * r.normal;
  const VertexLook::Four view = b[0] * p.view_mm + b[1] * q.view_mm + b[2] * r.view_mm;
  Vec3f colour;
  for (std::size_t c = 0; c < 3; ++c) colour[c] = light[c] * material.albedo[c] + view[3];
  if (material.gloss > soft_gloss) {
    const Vec3f mirrored = highlights({normal[0], normal[1], normal[2]}, {view[0], view[1], view[2]}, material.gloss);
    for (std::size_t c = 0; c < 3; ++c) colour[c] += light[3] * mirrored[c];
  }
  return {colour, normal[3]};
}

struct Pictures {
  const Scene& scene;
  const Raster& opaque;
  const Lashes& lashes;
  Vec3f background;
};

bool lash_covers(const Pictures& pictures, int x, int y) {
  const std::int32_t lash = pictures.lashes.triangle_at(x, y);
  if (lash < 0) return false;
  const Lashes& overlay = pictures.lashes;
  return overlay.raster.inverse_depth_per_mm[overlay.raster.index(x - overlay.x0, y - overlay.y0)] >
         pictures.opaque.inverse_depth_per_mm[pictures.opaque.index(x, y)];
}

Vec3f opaque_colour(const Pictures& pictures, int x, int y) {
  const Scene& scene = pictures.scene;
  const std::int32_t triangle = pictures.opaque.triangles[pictures.opaque.index(x, y)];
  return triangle < 0 ? pictures.background : shade_sample(scene, scene.opaque, scene.screen, triangle, x, y).colour;
}

Vec3f sample_colour(const Pictures& pictures, int x, int y) {
  const Scene& scene = pictures.scene;
  Vec3f colour = opaque_colour(pictures, x, y);
  if (lash_covers(pictures, x, y)) {
    const Lashes& overlay = pictures.lashes;
    const Shaded lash =
        shade_sample(scene, scene.lashes, overlay.screen, overlay.triangle_at(x, y), x - overlay.x0, y - overlay.y0);
    for (std::size_t c = 0; c < 3; ++c) colour[c] += lash.opacity * (lash.colour[c] - colour[c]);
  }
  // Clamped before the mean of the samples: an overbright one must not bleed over an edge.
  for (float& channel : colour) channel = std::min(1.0f, channel);
  return colour;
}

// Samples that see the same part at nearly the same depth differ by little: they are shaded once, at the first one.
bool alike(const Pictures& pictures, int x, int y, int n) {
  const Raster& raster = pictures.opaque;
  const std::uint16_t* parts = pictures.scene.opaque.parts.data();
  const std::size_t first = raster.index(x, y);
  const std::int32_t triangle = raster.triangles[first];
  const float depth = raster.inverse_depth_per_mm[first], tolerance = 0.002f * depth;
  bool same = true;
  for (int j = 0; j < n; ++j) {
    const std::size_t row = raster.index(x, y + j);
    for (std::size_t sample = row; sample < row + static_cast<std::size_t>(n); ++sample)
      same = same && std::abs(raster.inverse_depth_per_mm[sample] - depth) <= tolerance &&
             (triangle < 0 || parts[raster.triangles[sample]] == parts[triangle]);
  }
  return same;  // where nothing is seen, depths of 0 tell it
}

// Mean of a pixel's samples.
Vec3f pixel_colour(const Pictures& pictures, int x, int y, int n) {
  if (!pictures.lashes.touches(x, y, n) && alike(pictures, x, y, n)) return opaque_colour(pictures, x, y);
  Vec3f sum = {0, 0, 0};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Vec3f colour = sample_colour(pictures, x + i, y + j);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
    }
  for (float& channel : sum) channel /= static_cast<float>(n * n);
  return sum;
}

Image resolve(const Pictures& pictures, const SrgbTable& srgb, const RenderHeadOptions& options) {
  const int n = options.samples;
  Image image{options.width_px, options.height_px, 3, {}};
  image.pixels.resize(static_cast<std::size_t>(options.width_px) * static_cast<std::size_t>(options.height_px) * 3);
  std::uint8_t* out = image.pixels.data();
  for (int y = 0; y < options.height_px; ++y)
    for (int x = 0; x < options.width_px; ++x, out += 3) {
      const Vec3f colour = pixel_colour(pictures, x * n, y * n, n);
      for (std::size_t c = 0; c < 3; ++c) out[c] = srgb.encoded(colour[c]);
    }
  return image;
}

}  // namespace

Camera head_camera(const Rig& rig, const RenderHeadOptions& options) {
  const Bounds bounds = framed_bounds(rig, options.framing);
  check(!bounds.empty, "the rig has no visible polygon to render");
  Vec3f centre;
  for (std::size_t i = 0; i < 3; ++i) centre[i] = 0.5f * (bounds.low[i] + bounds.high[i]);
  double distance = options.distance_mm;
  if (distance == 0) {
    const double half_tan = std::tan(0.5 * options.field_of_view_deg * std::numbers::pi / 180.0);
    const double aspect = static_cast<double>(options.width_px) / options.height_px;
    const double height = bounds.high[1] - bounds.low[1], width = bounds.high[0] - bounds.low[0];
    distance = 0.5 * margin * std::max(height, width / aspect) / half_tan + 0.5 * (bounds.high[2] - bounds.low[2]);
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
  for (std::size_t i = 0; i < weights.values.size(); ++i)
    check(std::isfinite(weights.values[i]), "weight ", i, " is ", weights.values[i], ", expected a finite number");
  const SrgbTable srgb;
  const Camera camera = supersampled(head_camera(rig, options), options.samples);
  Scene scene = make_scene(rig, weights, camera, srgb);
  RasterOptions raster_options;
  raster_options.width_px = options.width_px * options.samples;
  raster_options.height_px = options.height_px * options.samples;
  raster_options.culling = Culling::none;
  const Raster opaque = rasterize(scene.screen, scene.opaque.triangles, raster_options);
  add_screen_occlusion(opaque, camera, scene);
  light_scene(scene);
  const Lashes lashes = draw_lashes(scene, raster_options);
  const Vec3f background = {srgb.linear(static_cast<float>(options.background_red)),
                            srgb.linear(static_cast<float>(options.background_green)),
                            srgb.linear(static_cast<float>(options.background_blue))};
  return resolve({scene, opaque, lashes, background}, srgb, options);
}

}  // namespace face::render
