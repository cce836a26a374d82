// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/draw_face.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/model/light_model.h"
#include "nodes/model/skin_atlas.h"
#include "nodes/model/skin_modes.h"
#include "nodes/render/camera.h"
#include "nodes/render/mouth_light.h"
#include "nodes/texture/mouth_white.h"
#include "nodes/texture/posed_face.h"
#include "nodes/texture/texel_colour.h"

namespace face::texture {
namespace {

// Where drawing fades, mm: below the eyes, above the neck, in front of the ears.
constexpr float below_eyes_mm = 4, eyes_fade_mm = 14, below_chin_mm = 2, chin_fade_mm = 12, ears_fade_mm = 22;

constexpr double full_albedo = 0.75;  // of what looks like that in full light: teeth
constexpr double most_teeth = 0.95;   // sRGB

float smooth_step(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

bool in_mouth(const std::string& part) {
  for (const char* word : {"mouth", "gum", "tongue", "teeth"})
    if (part.find(word) != std::string::npos) return true;
  return false;
}

// How much of a vertex's motion the picture beside the face follows: all at the mouth and below, nothing above the
// nose's base. V; without landmarks nothing.
std::vector<float> followed_share(const Rig& person) {
  const std::vector<Vec3f>& points = person.neutral.points_mm;
  std::vector<float> share(points.size(), 0.0f);
  if (person.landmarks68.size() != 68) return share;
  const float mouth = 0.5f * (points[person.landmarks68[48]][1] + points[person.landmarks68[54]][1]);
  const float nose = points[person.landmarks68[33]][1];
  for (std::size_t v = 0; v < points.size(); ++v) share[v] = 1 - smooth_step(mouth, nose, points[v][1]);
  return share;
}

}  // namespace

std::vector<float> drawn_share(const Rig& person) {
  const std::vector<Vec3f>& points = person.neutral.points_mm;
  std::vector<float> share(points.size(), 1.0f);
  if (person.landmarks68.size() != 68) return share;
  const auto mark = [&](std::size_t i) { return points[person.landmarks68[i]]; };
  const float eyes = 0.25f * (mark(40)[1] + mark(41)[1] + mark(46)[1] + mark(47)[1]) - below_eyes_mm;
  const float chin = mark(8)[1] - below_chin_mm;
  const float ears = 0.5f * (mark(1)[2] + mark(15)[2]);
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Vec3f& p = points[v];
    share[v] = (1 - smooth_step(eyes - eyes_fade_mm, eyes, p[1])) * smooth_step(chin - chin_fade_mm, chin, p[1]) *
               smooth_step(ears, ears + ears_fade_mm, p[2]);
  }
  return share;
}

FaceLayer draw_face(const Rig& person, const AlbedoMap& albedo, const std::vector<Vec3f>& points_mm,
                    const std::vector<Vec3f>& was_mm, const FaceFit& fit, const DrawFaceOptions& options) {
  const int samples = options.samples;
  check(albedo.width > 0 && albedo.height > 0 &&
            albedo.albedo.size() == static_cast<std::size_t>(albedo.width) * static_cast<std::size_t>(albedo.height),
        "albedo has ", albedo.albedo.size(), " texels, expected ", albedo.width, " x ", albedo.height);
  const auto all_finite = [](const Vec3f& p) { return std::isfinite(p[0] + p[1] + p[2]); };
  check(std::all_of(points_mm.begin(), points_mm.end(), all_finite) &&
            std::all_of(person.neutral.points_mm.begin(), person.neutral.points_mm.end(), all_finite),
        "person has a vertex that is not a number, or infinite");
  const auto& uvs = person.neutral.uvs;
  check(std::all_of(uvs.begin(), uvs.end(), [](const Vec2f& uv) { return std::isfinite(uv[0] + uv[1]); }),
        "person has a uv that is not a number, or infinite");
  const Mesh& mesh = person.neutral;
  check(was_mm.size() == points_mm.size(), "was_mm has ", was_mm.size(), " vertices, points_mm ", points_mm.size());
  const PosedFace face = pose_face(mesh, points_mm, fit, samples);
  const std::vector<render::ScreenPoint> was = render::project(render::supersampled(fit.camera, samples), was_mm);
  const std::vector<float> followed = followed_share(person);
  const std::vector<float> share = drawn_share(person);
  const std::vector<render::Triangle> corners = model::uv_corners(mesh, face.solid);
  const model::SkinAtlas atlas = model::make_skin_atlas(mesh);
  const std::vector<Vec3f> own = model::vertex_albedo(mesh);
  const render::MouthLight mouth = render::mouth_light(person, points_mm, render::photographs_gain);
  std::vector<char> mouth_part(mesh.parts.size()), teeth_part(mesh.parts.size());
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    mouth_part[p] = in_mouth(mesh.parts[p].name);
    teeth_part[p] = mesh.parts[p].name.find("teeth") != std::string::npos;
  }

  const MouthWhite white = mouth_white(person, albedo, atlas, face, fit.light);
  FaceLayer layer;
  layer.width = fit.image_width_px;
  layer.height = fit.image_height_px;
  const std::size_t pixels = static_cast<std::size_t>(layer.width) * static_cast<std::size_t>(layer.height);
  layer.colour.assign(pixels, Vec3f{0, 0, 0});
  layer.alpha.assign(pixels, 0.0f);
  layer.cover.assign(pixels, 0.0f);
  layer.mouth_colour.assign(pixels, Vec3f{0, 0, 0});
  layer.mouth.assign(pixels, 0.0f);
  layer.teeth.assign(pixels, 0.0f);
  layer.shift_px.assign(pixels, Vec2f{0, 0});
  const float part_of_pixel = 1.0f / static_cast<float>(samples * samples);
  for (int y = 0; y < face.raster.height_px; ++y)
    for (int x = 0; x < face.raster.width_px; ++x) {
      const std::int32_t found = face.raster.triangles[face.raster.index(x, y)];
      if (found < 0) continue;
      const auto t = static_cast<std::size_t>(found);
      const std::size_t pixel = static_cast<std::size_t>(y / samples) * static_cast<std::size_t>(layer.width) +
                                static_cast<std::size_t>(x / samples);
      layer.cover[pixel] += part_of_pixel;
      const bool is_mouth = !mesh.parts.empty() && mouth_part[face.solid.parts[t]] != 0;
      const bool is_teeth = is_mouth && teeth_part[face.solid.parts[t]] != 0;
      if (!face.skin[t] && !is_mouth) continue;
      const render::Triangle& triangle = face.solid.triangles[t];
      const Vec3f b = render::barycentrics_at(face.screen, triangle, static_cast<float>(x), static_cast<float>(y));
      float drawn = 0, exposure = 0;
      double parallel = 0;
      Vec2f shift{};
      Vec3f colour{};
      for (std::size_t i = 0; i < 3; ++i) {
        drawn += b[i] * (is_mouth ? 1.0f : share[triangle[i]]);
        exposure += b[i] * mouth.exposure[triangle[i]];
        parallel += static_cast<double>(b[i]) * face.parallel[triangle[i]];
        const std::uint32_t vertex = triangle[i];
        shift[0] += b[i] * followed[vertex] * (face.screen[vertex].x_px - was[vertex].x_px);
        shift[1] += b[i] * followed[vertex] * (face.screen[vertex].y_px - was[vertex].y_px);
        for (std::size_t c = 0; c < 3; ++c) colour[c] += b[i] * own[triangle[i]][c];
      }
      drawn = std::clamp(drawn, 0.0f, 1.0f);
      if (drawn <= 0) continue;
      if (face.skin[t]) {
        float u = 0, v = 0;
        for (std::size_t i = 0; i < 3; ++i) {
          u += b[i] * atlas.uvs[corners[t][i]][0];
          v += b[i] * atlas.uvs[corners[t][i]][1];
        }
        colour = colour_at(albedo, {u, v});
      }
      std::array<double, 3> lit{}, value{};
      for (std::size_t c = 0; c < 3; ++c) lit[c] = model::light_at(fit.light, c, parallel) * colour[c];
      if (!is_mouth) value = model::shown(fit.light, lit);
      for (std::size_t c = 0; is_mouth && c < 3; ++c) {
        const double arrives =
            std::min(1.0, exposure + white.parallel * parallel + (1.0 - exposure) * mouth.bounced[c]);
        value[c] = white.colour[c] * srgb_of(arrives * colour[c]) / srgb_of(full_albedo);
        if (is_teeth) value[c] = std::min(most_teeth, options.teeth_gain[c] * value[c]);
      }
      layer.alpha[pixel] += drawn * part_of_pixel;
      for (std::size_t k = 0; k < 2; ++k)
        layer.shift_px[pixel][k] += drawn * part_of_pixel * shift[k] / static_cast<float>(samples);
      if (is_mouth) layer.mouth[pixel] += part_of_pixel;
      if (is_teeth) layer.teeth[pixel] += part_of_pixel;
      for (std::size_t c = 0; c < 3; ++c) {
        const float shown = drawn * part_of_pixel * static_cast<float>(std::clamp(value[c], 0.0, 1.0));
        layer.colour[pixel][c] += shown;
        if (is_mouth) layer.mouth_colour[pixel][c] += shown;
      }
    }
  return layer;
}

}  // namespace face::texture
