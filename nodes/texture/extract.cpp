// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/extract.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nodes/base/check.h"
#include "nodes/model/light_model.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/skin_atlas.h"
#include "nodes/render/rgb_image.h"
#include "nodes/texture/fill_ratio.h"
#include "nodes/texture/posed_face.h"

namespace face::texture {
namespace {

constexpr float depth_slack_mm = 3;     // of a texel behind what the pixel shows
constexpr double darkest_light = 0.03;  // below, its inverse is noise
constexpr double open_gap_mm = 0.5;     // from which a mouth may show teeth
constexpr float rim_mm = 2;             // of the lips that is not read then; twice as far all counts
constexpr float sure_weight = 0.12f;    // from which a texel is the picture's alone

// How many pixels every skin pixel is from one that shows something else, at most 3.
std::vector<std::uint8_t> pixels_to_edge(const PosedFace& face) {
  const render::Raster& raster = face.raster;
  std::vector<std::uint8_t> distance(raster.triangles.size());
  for (std::size_t i = 0; i < distance.size(); ++i)
    distance[i] = raster.triangles[i] >= 0 && face.skin[static_cast<std::size_t>(raster.triangles[i])] ? 3 : 0;
  for (int pass = 1; pass < 3; ++pass) {
    std::vector<std::uint8_t> next = distance;
    for (int y = 0; y < raster.height_px; ++y)
      for (int x = 0; x < raster.width_px; ++x) {
        std::uint8_t& here = next[raster.index(x, y)];
        if (here == 0) continue;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const int nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= raster.width_px || ny >= raster.height_px) continue;
            here = std::min<std::uint8_t>(here, static_cast<std::uint8_t>(distance[raster.index(nx, ny)] + 1));
          }
      }
    distance = std::move(next);
  }
  return distance;
}

// 0 at the inner rim of the lips of an open mouth, 1 a little away from it: a fit that is off by a pixel paints teeth
// on the lips there. 1 everywhere where the mouth is closed, or the model has no landmarks.
std::vector<float> away_from_teeth(const MorphableModel& model, const FaceFit& fit) {
  const std::vector<Vec3f>& points = model.mean.points_mm;
  std::vector<float> share(points.size(), 1.0f);
  if (fit.lip_gap_mm < open_gap_mm || model.landmarks68.size() != 68) return share;
  for (std::size_t v = 0; v < points.size(); ++v) {
    float nearest = 1e9f;
    for (std::size_t i = 0; i < 8; ++i)
      for (int step = 0; step < 4; ++step) {
        const Vec3f &a = points[model.landmarks68[60 + i]], &b = points[model.landmarks68[60 + (i + 1) % 8]];
        const float t = 0.25f * static_cast<float>(step);
        float squares = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const float d = points[v][k] - a[k] - t * (b[k] - a[k]);
          squares += d * d;
        }
        nearest = std::min(nearest, std::sqrt(squares));
      }
    share[v] = std::clamp((nearest - rim_mm) / rim_mm, 0.0f, 1.0f);
  }
  return share;
}

std::array<double, 3> bilinear(const Image& image, double x, double y) {
  x = std::clamp(x, 0.0, image.width - 1.001);
  y = std::clamp(y, 0.0, image.height - 1.001);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const double fx = x - x0, fy = y - y0;
  std::array<double, 3> value{};
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const double share = (dx == 1 ? fx : 1 - fx) * (dy == 1 ? fy : 1 - fy);
      const std::uint8_t* pixel =
          image.pixels.data() + 3 * (static_cast<std::size_t>(y0 + dy) * static_cast<std::size_t>(image.width) +
                                     static_cast<std::size_t>(x0 + dx));
      for (std::size_t c = 0; c < 3; ++c) value[c] += share * pixel[c] / 255.0;
    }
  return value;
}

}  // namespace

AlbedoMap extract(const MorphableModel& model, const Image& picture, const FaceFit& fit,
                  const ExtractOptions& options) {
  check(picture.width == fit.image_width_px && picture.height == fit.image_height_px, "the picture is ", picture.width,
        " x ", picture.height, " pixels, the fit was made on ", fit.image_width_px, " x ", fit.image_height_px);
  const Image rgb = render::rgb_image(picture);
  const PosedFace face = pose_face(model.mean, model::pose_model(model, fit.identity, fit.expression), fit, 1);
  const std::vector<Vec3f> model_albedo = model::albedo_of(model, fit.albedo);
  const std::vector<float> readable = away_from_teeth(model, fit);
  const std::vector<std::uint8_t> to_edge = pixels_to_edge(face);
  const model::SkinAtlas atlas = model::make_skin_atlas(model.mean);
  AlbedoMap map;
  map.width = map.height = static_cast<int>(options.size_px);
  const model::TexelMap texels = model::map_texels(atlas, map.width, map.height);
  const std::size_t count = texels.raster.triangles.size();
  map.albedo.assign(count, Vec3f{0, 0, 0});
  map.weight.assign(count, 0.0f);
  std::vector<Vec3f> estimate(count, Vec3f{0, 0, 0});
  const Vec3f& eye = fit.camera.position_mm;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const std::size_t texel = texels.raster.index(x, y);
      if (texels.raster.triangles[texel] < 0) continue;
      const auto& triangle = atlas.triangles[static_cast<std::size_t>(texels.raster.triangles[texel])];
      const Vec3f b = texels.weights_at(atlas, x, y);
      Vec3f point{}, normal{}, own{};
      double parallel = 0, trusted = 0, sx = 0, sy = 0, depth = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = triangle[i];
        for (std::size_t k = 0; k < 3; ++k) {
          point[k] += b[i] * face.points_mm[v][k];
          normal[k] += b[i] * face.normals[v][k];
          own[k] += b[i] * model_albedo[v][k];
        }
        parallel += static_cast<double>(b[i]) * face.parallel[v];
        trusted += static_cast<double>(b[i]) * readable[v];
        sx += static_cast<double>(b[i]) * face.screen[v].x_px;
        sy += static_cast<double>(b[i]) * face.screen[v].y_px;
        depth += static_cast<double>(b[i]) * face.screen[v].depth_mm;
      }
      for (float& value : own) value = std::max(value, 1e-3f);
      estimate[texel] = map.albedo[texel] = own;
      const long px = std::lround(sx), py = std::lround(sy);
      if (px < 0 || py < 0 || px >= rgb.width || py >= rgb.height) continue;
      const std::size_t pixel = face.raster.index(static_cast<int>(px), static_cast<int>(py));
      if (to_edge[pixel] < 2 || depth > 1.0 / face.raster.inverse_depth_per_mm[pixel] + depth_slack_mm) continue;
      double dot = 0, length = 0, normal_length = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double ray = static_cast<double>(eye[k]) - point[k];
        dot += ray * normal[k];
        length += ray * ray;
        normal_length += static_cast<double>(normal[k]) * normal[k];
      }
      const double facing = dot / std::sqrt(length * normal_length);
      if (facing <= 0 || trusted <= 0) continue;
      const std::array<double, 3> lit = model::lit_of(fit.light, bilinear(rgb, sx, sy));
      double weight = trusted * facing * facing * (to_edge[pixel] == 2 ? 0.4 : 1.0);
      for (std::size_t c = 0; c < 3; ++c) {
        const double strength = model::light_at(fit.light, c, parallel);
        weight *= std::clamp(strength / darkest_light - 1.0, 0.0, 1.0);
        map.albedo[texel][c] = static_cast<float>(std::max(1e-3, lit[c] / std::max(strength, darkest_light)));
      }
      map.weight[texel] = static_cast<float>(weight);
    }
  fill_ratio(estimate, sure_weight, map);
  return map;
}

}  // namespace face::texture
