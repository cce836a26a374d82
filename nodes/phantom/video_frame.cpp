// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/video_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/phantom/cast_shadow.h"
#include "nodes/phantom/dot_painter.h"
#include "nodes/phantom/head_view.h"
#include "nodes/phantom/sensor_noise.h"
#include "nodes/phantom/srgb_curve.h"
#include "nodes/phantom/vector3.h"
#include "nodes/render/draw_lashes.h"
#include "nodes/render/rgb_image.h"
#include "nodes/render/scene.h"

namespace face::phantom {
namespace {

using Four = float __attribute__((vector_size(16)));

// What is interpolated over a triangle.
struct Look {
  Four normal = {0, 0, 0, 0};  // unit; share of the ambient light that arrives
  Four albedo = {0, 0, 0, 0};  // of vertex colour; share of the parallel light that arrives
  Four point = {0, 0, 0, 0};   // mm; opacity
  Four inner = {0, 0, 0, 0};   // in the mouth: the light that arrives
};

struct Material {
  Vec3f albedo = {1, 1, 1};
  float gloss = 0;
  bool in_mouth = false;
};

// Everything in the head's frame.
struct Lit {
  render::Scene scene;
  std::vector<Look> looks;          // V
  std::vector<Material> materials;  // per part
  Lighting lighting;
  DotPainter dots;
  bool highlight;
};

bool in_mouth(const std::string& part) {
  for (const char* name : {"mouth", "gum", "tongue", "teeth"})
    if (part.find(name) != std::string::npos) return true;
  return false;
}

// Light in the mouth: what falls on the opening between the lips, thinned out with depth, and what its walls pass on.
Vec3f light_in_mouth(const render::Scene& scene, std::size_t v, const Lighting& lighting, const Vec3f& outside) {
  constexpr Vec3f reddened = {1.0f, 0.68f, 0.48f};  // by lips, cheeks and gums on the way in
  const Vec3f& p = scene.points_mm[v];
  const Vec3f& o = scene.mouth.opening_mm;
  const float exposure = scene.exposure[v];
  const float cosine = render::dot(scene.normals[v], render::normalized({o[0] - p[0], o[1] - p[1], o[2] - p[2]}));
  const float facing = std::max(0.0f, 0.35f + 0.65f * cosine);
  const float back = 0.4f + 0.6f * std::min(1.0f, exposure / 0.3f);
  const float frontal = std::max(0.0f, lighting.towards_light[2]);
  Vec3f light;
  for (std::size_t c = 0; c < 3; ++c) {
    const float in_front = lighting.ambient[c] + lighting.parallel[c] * frontal;
    const float through = in_front * (reddened[c] + (1 - reddened[c]) * exposure * exposure) * facing;
    light[c] = exposure * (through + exposure * (outside[c] - through)) + back * in_front * scene.mouth.bounced[c];
  }
  return light;
}

void make_looks(const Mesh& mesh, const VideoFrameOptions& options, const render::SrgbTable& srgb, Lit& lit) {
  const render::Scene& scene = lit.scene;
  const Lighting& lighting = lit.lighting;
  for (const Part& part : mesh.parts) {
    Material material{part.albedo_srgb, part.gloss, options.shadow && in_mouth(part.name)};
    if (options.gamma)
      for (float& channel : material.albedo) channel = srgb.linear(channel);
    lit.materials.push_back(material);
  }
  if (lit.materials.empty()) lit.materials.emplace_back();
  std::vector<float> seen;
  if (options.shadow)
    seen = cast_shadow(scene.points_mm, scene.normals, scene.opaque.triangles, lighting.towards_light, 4.0f);
  lit.looks.resize(scene.points_mm.size());
  for (std::size_t v = 0; v < lit.looks.size(); ++v) {
    const Vec3f& n = scene.normals[v];
    const Vec3f& p = scene.points_mm[v];
    Vec3f albedo = mesh.colors_srgb.empty() ? Vec3f{1, 1, 1} : options.gamma ? scene.tint[v] : mesh.colors_srgb[v];
    const bool mouth = options.shadow && scene.mouth.inside[v];
    if (mouth && options.gamma) {
      constexpr Vec3f darkest_flesh = {0.20f, 0.038f, 0.033f};  // linear; a throat painted black is still flesh
      for (std::size_t c = 0; c < 3; ++c) albedo[c] = std::max(albedo[c], darkest_flesh[c]);
    }
    Look& look = lit.looks[v];
    look.normal = Four{n[0], n[1], n[2], options.shadow ? scene.exposure[v] : 1.0f};
    look.albedo = Four{albedo[0], albedo[1], albedo[2], options.shadow ? seen[v] : 1.0f};
    look.point = Four{p[0], p[1], p[2], scene.opacity[v]};
    if (mouth) {
      Vec3f outside;
      const float cosine = std::max(0.0f, render::dot(n, lighting.towards_light)) * seen[v];
      for (std::size_t c = 0; c < 3; ++c) outside[c] = lighting.ambient[c] + lighting.parallel[c] * cosine;
      const Vec3f inner = light_in_mouth(scene, v, lighting, outside);
      look.inner = Four{inner[0], inner[1], inner[2], 0};
    }
  }
}

struct Shaded {
  Vec3f colour;
  float opacity;
};

Shaded shade(const Lit& lit, const render::Triangulation& mesh, const std::vector<render::ScreenPoint>& screen,
             std::int32_t triangle_index, int x, int y) {
  const auto t = static_cast<std::size_t>(triangle_index);
  const render::Triangle& triangle = mesh.triangles[t];
  const std::uint16_t part = mesh.parts[t];
  const Material& material = lit.materials[part];
  const Vec3f b = render::barycentrics_at(screen, triangle, static_cast<float>(x), static_cast<float>(y));
  const Look &p = lit.looks[triangle[0]], &q = lit.looks[triangle[1]], &r = lit.looks[triangle[2]];
  const Four normal4 = b[0] * p.normal + b[1] * q.normal + b[2] * r.normal;
  const Four albedo4 = b[0] * p.albedo + b[1] * q.albedo + b[2] * r.albedo;
  const Four point = b[0] * p.point + b[1] * q.point + b[2] * r.point;
  const Lighting& lighting = lit.lighting;
  const Vec3f normal = render::normalized({normal4[0], normal4[1], normal4[2]});
  const Vec3f place = {point[0], point[1], point[2]};
  Vec3f albedo = {albedo4[0] * material.albedo[0], albedo4[1] * material.albedo[1], albedo4[2] * material.albedo[2]};
  lit.dots.paint(place, part, albedo);
  const float cosine = render::dot(normal, lighting.towards_light);
  const float direct = std::max(0.0f, cosine) * albedo4[3];
  Vec3f colour;
  if (material.in_mouth) {
    const Four inner = b[0] * p.inner + b[1] * q.inner + b[2] * r.inner;
    for (std::size_t c = 0; c < 3; ++c) colour[c] = inner[c] * albedo[c];
  } else {
    for (std::size_t c = 0; c < 3; ++c)
      colour[c] = (lighting.ambient[c] * normal4[3] + lighting.parallel[c] * direct) * albedo[c];
  }
  if (lit.highlight && material.gloss > 0 && cosine > 0) {
    const Vec3f& eye = lit.scene.eye_mm;
    const Vec3f view = render::normalized({eye[0] - place[0], eye[1] - place[1], eye[2] - place[2]});
    const int doublings = 3 + static_cast<int>(material.gloss * 5.5f);
    const float mirrored =
        render::highlight({lighting.towards_light, {1, 1, 1}}, normal, view, material.gloss, doublings) * albedo4[3] *
        normal4[3];
    for (std::size_t c = 0; c < 3; ++c) colour[c] += lighting.parallel[c] * mirrored;
  }
  return {colour, point[3]};
}

// The picture before the camera's colours, height x width.
class Exposure {
 public:
  Exposure(const Lit& lit, const render::RasterOptions& raster, render::Raster opaque, int samples)
      : lit_(lit), opaque_(std::move(opaque)), lashes_(render::draw_lashes(lit.scene, raster)), n_(samples) {}

  // The mean of a pixel's samples over this background.
  Vec3f pixel(int column, int row, const Vec3f& background) const {
    const int x = column * n_, y = row * n_;
    if (!lashes_.touches(x, y, n_) && alike(x, y)) return opaque_colour(x, y, background);
    Vec3f sum = {0, 0, 0};
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) {
        const Vec3f colour = sample(x + i, y + j, background);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += std::min(1.5f, colour[c]);
      }
    for (float& channel : sum) channel /= static_cast<float>(n_ * n_);
    return sum;
  }

 private:
  Vec3f opaque_colour(int x, int y, const Vec3f& background) const {
    const std::int32_t triangle = opaque_.triangles[opaque_.index(x, y)];
    return triangle < 0 ? background : shade(lit_, lit_.scene.opaque, lit_.scene.screen, triangle, x, y).colour;
  }
  Vec3f sample(int x, int y, const Vec3f& background) const {
    Vec3f colour = opaque_colour(x, y, background);
    const int column = x - lashes_.x0, row = y - lashes_.y0;
    if (column < 0 || row < 0 || column >= lashes_.raster.width_px || row >= lashes_.raster.height_px) return colour;
    const std::size_t at = lashes_.raster.index(column, row);
    const std::int32_t lash = lashes_.raster.triangles[at];
    if (lash < 0 || lashes_.raster.inverse_depth_per_mm[at] <= opaque_.inverse_depth_per_mm[opaque_.index(x, y)])
      return colour;
    const Shaded shaded = shade(lit_, lit_.scene.lashes, lashes_.screen, lash, column, row);
    for (std::size_t c = 0; c < 3; ++c) colour[c] += shaded.opacity * (shaded.colour[c] - colour[c]);
    return colour;
  }
  // Samples that see the same part at nearly the same depth differ by little: they are shaded once, at the first one.
  bool alike(int x, int y) const {
    const std::size_t first = opaque_.index(x, y);
    const std::int32_t triangle = opaque_.triangles[first];
    const float depth = opaque_.inverse_depth_per_mm[first], tolerance = 0.002f * depth;
    const std::uint16_t* parts = lit_.scene.opaque.parts.data();
    for (int j = 0; j < n_; ++j) {
      const std::size_t row = opaque_.index(x, y + j);
      for (std::size_t s = row; s < row + static_cast<std::size_t>(n_); ++s) {
        if (std::abs(opaque_.inverse_depth_per_mm[s] - depth) > tolerance) return false;
        if (triangle >= 0 && parts[opaque_.triangles[s]] != parts[triangle]) return false;
      }
    }
    return true;  // where nothing is seen, depths of 0 tell it
  }

  const Lit& lit_;
  render::Raster opaque_;
  render::Lashes lashes_;
  int n_;
};

}  // namespace

Image video_frame(const Rig& rig, const Weights& weights, const RigidMotion* world_from_head, const Camera& camera,
                  const Lighting& lighting, const SurfaceDots* dots, const Image* backdrop, const std::string* id,
                  const VideoFrameOptions& options) {
  check(options.width_px > 0 && options.height_px > 0, "the picture is ", options.width_px, " x ", options.height_px,
        " pixels, expected at least 1 x 1");
  check(options.samples >= 1, "samples is ", options.samples, ", expected at least 1");
  const Mesh& mesh = rig.neutral;
  check(mesh.colors_srgb.empty() || mesh.colors_srgb.size() == mesh.points_mm.size(), "the rig has ",
        mesh.colors_srgb.size(), " vertex colours, but ", mesh.points_mm.size(), " vertices");
  Image wall;
  if (backdrop != nullptr) {
    wall = render::rgb_image(*backdrop);
    check(wall.width == options.width_px && wall.height == options.height_px, "the backdrop is ", wall.width, " x ",
          wall.height, " pixels, but the picture ", options.width_px, " x ", options.height_px);
  }
  const render::SrgbTable srgb;
  const Camera seen_from = render::supersampled(camera_in_head(camera, world_from_head), options.samples);
  render::Scene scene = render::make_scene(rig, weights, seen_from, srgb);
  render::RasterOptions raster;
  raster.width_px = options.width_px * options.samples;
  raster.height_px = options.height_px * options.samples;
  raster.culling = render::Culling::none;
  Lit lit{std::move(scene), {}, {}, lighting, DotPainter(nullptr, {}, {}, ColourSpace::srgb), options.highlight};
  lit.lighting.towards_light = direction_in_head(lighting.towards_light, world_from_head);
  render::Raster opaque = render::rasterize(lit.scene.screen, lit.scene.opaque.triangles, raster);
  if (options.shadow) render::add_screen_occlusion(opaque, seen_from, lit.scene);
  lit.dots =
      DotPainter(dots, lit.scene.points_mm, lit.scene.opaque, options.gamma ? ColourSpace::linear : ColourSpace::srgb);
  make_looks(mesh, options, srgb, lit);
  const Exposure exposure(lit, raster, std::move(opaque), options.samples);
  const SrgbCurve curve;
  const NormalTable normal;
  const PixelNoise noise(options.seed, id == nullptr ? std::string() : *id, 0);
  const auto grain = static_cast<float>(options.grain);
  const auto coded = [&](float srgb_value) { return options.gamma ? srgb.linear(srgb_value) : srgb_value; };
  const float grey = coded(0.45f);
  Image image{options.width_px, options.height_px, 3, {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  std::size_t at = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x, at += 3) {
      Vec3f background = {grey, grey, grey};
      if (backdrop != nullptr)
        for (std::size_t c = 0; c < 3; ++c) background[c] = coded(static_cast<float>(wall.pixels[at + c]) / 255.0f);
      Vec3f colour = exposure.pixel(x, y, background);
      if (options.gamma)
        for (float& channel : colour) channel = curve(channel);
      const float luminance = 0.3f * colour[0] + 0.59f * colour[1] + 0.11f * colour[2];
      std::uint64_t random = grain > 0 ? noise.bits(at / 3) : 0;
      for (std::size_t c = 0; c < 3; ++c, random >>= 12) {
        const float mixed = lighting.contrast * colour[c] + (1 - lighting.contrast) * luminance;
        float level = 255.0f * (lighting.gain[c] * mixed + lighting.offset[c]);
        if (grain > 0) level += grain * normal[random];
        image.pixels[at + c] = static_cast<std::uint8_t>(std::clamp(level, 0.0f, 255.0f) + 0.5f);
      }
    }
  return image;
}

}  // namespace face::phantom
