// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/extract.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/model/light_model.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/skin_atlas.h"
#include "nodes/render/rgb_image.h"
#include "nodes/render/shade.h"
#include "nodes/texture/continue_background.h"
#include "nodes/texture/fill_ratio.h"
#include "nodes/texture/nostril_shade.h"
#include "nodes/texture/posed_face.h"

namespace face::texture {
namespace {

constexpr float depth_slack_mm = 3;     // of a texel behind what the pixel shows
constexpr double step_mm = 10;          // of depth from a pixel to the next, from which one hides the other
constexpr double steepest = 6;          // slope of skin that is still read where pixels are large
constexpr double darkest_light = 0.03;  // below, its inverse is noise
constexpr double open_gap_mm = 0.5;     // from which a mouth may show teeth
constexpr float rim_mm = 2;             // of the lips that is not read then; twice as far all counts
constexpr double teeth_mm = 6,
                 lips_mm = 10;            // from the rim, as far as a fit that is off may paint teeth; where lips are
constexpr double pale = 0.2, dark = 0.5;  // logarithms: less red than lips, less bright, from which it is none
constexpr float far_mm = 1e3;
// By how much an expression turns the skin, degrees, from which it lies in a fold: its shadow is no colour of the skin;
// and from which nothing of it is read.
constexpr double fold_deg = 12, deep_fold_deg = 24;
constexpr float beside_fold_mm = 4;   // a fit is never exact: as far beside folds nothing is read either
constexpr float sure_weight = 0.12f;  // from which a texel is the picture's alone

// How many pixels every skin pixel is from one that shows something else, at most 3: no skin, or skin far behind or in
// front of it, as neck beside the chin's outline.
std::vector<std::uint8_t> pixels_to_edge(const PosedFace& face, double mm_per_px) {
  const render::Raster& raster = face.raster;
  const double step = std::max(step_mm, steepest * mm_per_px);
  std::vector<std::uint8_t> distance(raster.triangles.size());
  for (std::size_t i = 0; i < distance.size(); ++i)
    distance[i] = raster.triangles[i] >= 0 && face.skin[static_cast<std::size_t>(raster.triangles[i])] ? 3 : 0;
  const auto step_apart = [&](std::size_t a, std::size_t b) {
    return distance[a] > 0 && distance[b] > 0 &&
           std::abs(1 / raster.inverse_depth_per_mm[a] - 1 / raster.inverse_depth_per_mm[b]) > step;
  };
  std::vector<std::size_t> at_step;
  for (int y = 0; y < raster.height_px; ++y)
    for (int x = 0; x < raster.width_px; ++x) {
      const std::size_t here = raster.index(x, y);
      if (x + 1 < raster.width_px && step_apart(here, raster.index(x + 1, y)))
        at_step.insert(at_step.end(), {here, raster.index(x + 1, y)});
      if (y + 1 < raster.height_px && step_apart(here, raster.index(x, y + 1)))
        at_step.insert(at_step.end(), {here, raster.index(x, y + 1)});
    }
  for (const std::size_t i : at_step) distance[i] = 1;
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

// How far every vertex is from the inner rim of the lips, mm; far where the mouth is closed, or without landmarks.
std::vector<float> from_rim(const MorphableModel& model, const FaceFit& fit) {
  const std::vector<Vec3f>& points = model.mean.points_mm;
  std::vector<float> distance_mm(points.size(), far_mm);
  if (fit.lip_gap_mm < open_gap_mm || model.landmarks68.size() != 68) return distance_mm;
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t i = 0; i < 8; ++i)
      for (int step = 0; step < 4; ++step) {
        const Vec3f &a = points[model.landmarks68[60 + i]], &b = points[model.landmarks68[60 + (i + 1) % 8]];
        const float t = 0.25f * static_cast<float>(step);
        float squares = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const float d = points[v][k] - a[k] - t * (b[k] - a[k]);
          squares += d * d;
        }
        distance_mm[v] = std::min(distance_mm[v], std::sqrt(squares));
      }
  return distance_mm;
}

// How much of every vertex's colour may be read: 1 where the expression leaves the skin as it lies at rest, 0 in folds.
// Lips turn without folding. from_rim_mm: of from_rim.
std::vector<float> outside_folds(const MorphableModel& model, const FaceFit& fit, const PosedFace& face,
                                 const std::vector<float>& from_rim_mm) {
  const std::vector<Vec3f> rest =
      render::vertex_normals(model::pose_model(model, fit.identity, {}), face.solid.triangles);
  std::vector<float> share(rest.size());
  for (std::size_t v = 0; v < rest.size(); ++v) {
    if (from_rim_mm[v] < lips_mm) {
      share[v] = 1;
      continue;
    }
    const double cosine = std::clamp(
        static_cast<double>(render::dot(render::normalized(rest[v]), render::normalized(face.normals[v]))), -1.0, 1.0);
    const double turn_deg = std::acos(cosine) * 180 / std::numbers::pi;
    share[v] = static_cast<float>(std::clamp((deep_fold_deg - turn_deg) / (deep_fold_deg - fold_deg), 0.0, 1.0));
  }
  const std::vector<Vec3f>& points = model.mean.points_mm;
  std::vector<float> spread = share;
  for (std::size_t v = 0; v < share.size(); ++v) {
    if (share[v] >= 1) continue;
    for (std::size_t w = 0; w < share.size(); ++w) {
      if (spread[w] <= share[v] || from_rim_mm[w] < lips_mm) continue;
      const Vec3f apart = {points[v][0] - points[w][0], points[v][1] - points[w][1], points[v][2] - points[w][2]};
      if (render::dot(apart, apart) < beside_fold_mm * beside_fold_mm) spread[w] = share[v];
    }
  }
  return spread;
}

// Of a texel read as `albedo` where the model has `estimate`: how much redder and how much brighter it is, logarithms.
std::array<double, 2> unlike(const Vec3f& albedo, const Vec3f& estimate) {
  const auto ratio = [&](std::size_t c) { return std::log(static_cast<double>(albedo[c]) / estimate[c]); };
  return {ratio(0) - ratio(1), model::luma[0] * ratio(0) + model::luma[1] * ratio(1) + model::luma[2] * ratio(2)};
}

// Takes the trust from what is no lip about an open mouth: teeth are paler than lips, the mouth's inside is darker.
// What lips are is the median of those that are safely away from the rim. from_lips_mm: of every texel.
void distrust_teeth(const std::vector<float>& from_lips_mm, const std::vector<Vec3f>& estimate, AlbedoMap& map) {
  std::vector<double> redder, brighter;
  for (std::size_t i = 0; i < from_lips_mm.size(); ++i) {
    if (map.weight[i] <= 0 || from_lips_mm[i] < teeth_mm || from_lips_mm[i] > lips_mm) continue;
    const auto [red, bright] = unlike(map.albedo[i], estimate[i]);
    redder.push_back(red);
    brighter.push_back(bright);
  }
  if (redder.empty()) return;
  const double red_lips = median(redder), bright_lips = median(brighter);
  for (std::size_t i = 0; i < from_lips_mm.size(); ++i) {
    if (map.weight[i] <= 0 || from_lips_mm[i] > lips_mm) continue;
    const auto [red, bright] = unlike(map.albedo[i], estimate[i]);
    const double paler = std::max(0.0, red_lips - red) / pale, darker = std::max(0.0, bright_lips - bright) / dark;
    const double near_rim = std::clamp((lips_mm - from_lips_mm[i]) / (lips_mm - teeth_mm), 0.0, 1.0);
    const double pale_odd = std::pow(paler, 4), dark_odd = std::pow(darker, 4);
    map.weight[i] *= static_cast<float>(1 - near_rim * pale_odd / (1 + pale_odd));
    // To a high power: where gaps are filled, many texels that are trusted a little add up to certainty.
    map.weight[i] *= static_cast<float>(std::pow(1 + dark_odd, -4 * near_rim));
  }
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
  const std::vector<float> rim = from_rim(model, fit), flat = outside_folds(model, fit, face, rim);
  const std::vector<std::uint8_t> to_edge = pixels_to_edge(face, 1 / face_scale_px(fit));
  const model::SkinAtlas atlas = model::make_skin_atlas(model.mean);
  AlbedoMap map;
  map.width = map.height = static_cast<int>(options.size_px);
  const model::TexelMap texels = model::map_texels(atlas, map.width, map.height);
  const std::size_t count = texels.raster.triangles.size();
  map.albedo.assign(count, Vec3f{0, 0, 0});
  map.weight.assign(count, 0.0f);
  std::vector<Vec3f> estimate(count, Vec3f{0, 0, 0});
  std::vector<float> texel_rim(count, far_mm), texel_shade(count, 1.0f);
  const std::vector<float> shade = nostril_shade(model);
  const Vec3f& eye = fit.camera.position_mm;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const std::size_t texel = texels.raster.index(x, y);
      if (texels.raster.triangles[texel] < 0) continue;
      const auto& triangle = atlas.triangles[static_cast<std::size_t>(texels.raster.triangles[texel])];
      const Vec3f b = texels.weights_at(atlas, x, y);
      Vec3f point{}, normal{}, own{};
      float from_lips = 0, flatness = 0, dark = 0;
      double parallel = 0, sx = 0, sy = 0, depth = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = triangle[i];
        for (std::size_t k = 0; k < 3; ++k) {
          point[k] += b[i] * face.points_mm[v][k];
          normal[k] += b[i] * face.normals[v][k];
          own[k] += b[i] * model_albedo[v][k];
        }
        parallel += static_cast<double>(b[i]) * face.parallel[v];
        from_lips += b[i] * rim[v];
        flatness += b[i] * flat[v];
        dark += b[i] * shade[v];
        sx += static_cast<double>(b[i]) * face.screen[v].x_px;
        sy += static_cast<double>(b[i]) * face.screen[v].y_px;
        depth += static_cast<double>(b[i]) * face.screen[v].depth_mm;
      }
      for (float& value : own) value = std::max(value, 1e-3f);
      texel_rim[texel] = from_lips;
      texel_shade[texel] = std::clamp(dark, 0.0f, 1.0f);
      // Nostrils are some texels wide and a fit some pixels off: what is read there is the skin beside them.
      const double trusted = std::clamp((from_lips - rim_mm) / rim_mm, 0.0f, 1.0f) * texel_shade[texel];
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
      double weight = trusted * flatness * facing * facing * (to_edge[pixel] == 2 ? 0.4 : 1.0);
      for (std::size_t c = 0; c < 3; ++c) {
        const double strength = model::light_at(fit.light, c, parallel);
        weight *= std::clamp(strength / darkest_light - 1.0, 0.0, 1.0);
        map.albedo[texel][c] = static_cast<float>(std::max(1e-3, lit[c] / std::max(strength, darkest_light)));
      }
      map.weight[texel] = static_cast<float>(weight);
    }
  distrust_teeth(texel_rim, estimate, map);
  fill_ratio(estimate, sure_weight, map);
  for (std::size_t i = 0; i < count; ++i) {
    const float unseen = 1 - std::min(1.0f, map.weight[i] / sure_weight);
    for (float& value : map.albedo[i]) value *= 1 - unseen * (1 - texel_shade[i]);
  }
  return map;
}

}  // namespace face::texture
