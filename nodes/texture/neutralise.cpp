// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/neutralise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/base/quantile.h"
#include "nodes/model/light_model.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/skin_atlas.h"
#include "nodes/model/skin_modes.h"
#include "nodes/render/shade.h"
#include "nodes/texture/draw_face.h"

namespace face::texture {
namespace {

constexpr float forehead_fade_mm = 6;   // above the brows and beside the temples, over which hair becomes possible
constexpr float cheek_hair_mm = 16;     // from the outline inwards, where hair may hang over cheeks
constexpr float cheek_fade_mm = 14;     // below the eyes, over which that begins
constexpr double beard_darker = 0.25;   // of the chin's skin below the cheeks', logarithm: hair that grows there
constexpr double reading_error = 0.02;  // of a pixel's value: of light and picture together
constexpr double chroma_sigma = 0.2;    // of skin about what the model's components say, logarithm
constexpr float below_chin_mm = 12;     // where collars begin
constexpr float least_albedo = 1e-3f;

// x of the outline of cheek and jaw at a height; points first .. first + 8 go down one side, or up.
float outline_x(const Rig& person, std::size_t first, float y) {
  const auto mark = [&](std::size_t i) { return person.neutral.points_mm[person.landmarks68[i]]; };
  for (std::size_t i = first; i < first + 8; ++i) {
    const Vec3f a = mark(i), b = mark(i + 1);
    if ((a[1] > y) == (b[1] > y)) continue;
    return a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]);
  }
  return mark(first == 0 ? 0 : 16)[0];
}

// 1 where hair or a collar may hide the skin: above the brows, beside them, below the chin, at the ears, and where
// there is no beard at the sides of the cheeks. V; all 0 without landmarks.
std::vector<float> under_hair(const Rig& person, bool has_beard) {
  const std::vector<Vec3f>& points = person.neutral.points_mm;
  std::vector<float> share(points.size(), 0.0f);
  if (person.landmarks68.size() != 68) return share;
  float brows = -1e9f;
  for (std::size_t i = 17; i < 27; ++i) brows = std::max(brows, points[person.landmarks68[i]][1]);
  const float right = points[person.landmarks68[17]][0], left = points[person.landmarks68[26]][0];
  const float eyes = points[person.landmarks68[36]][1], tip = points[person.landmarks68[8]][1];
  const float chin = tip - below_chin_mm;
  const float ears = 0.5f * (points[person.landmarks68[1]][2] + points[person.landmarks68[15]][2]);
  for (std::size_t v = 0; v < points.size(); ++v) {
    const float x = points[v][0], y = points[v][1];
    const float up = (y - brows) / forehead_fade_mm;
    // From the ends of the brows the limits go over to the sides of the cheeks.
    const float t = std::clamp((eyes - y) / cheek_fade_mm, 0.0f, 1.0f);
    const float right_limit = right + t * (outline_x(person, 0, y) + cheek_hair_mm - right);
    const float left_limit = left + t * (outline_x(person, 8, y) - cheek_hair_mm - left);
    float out = std::max(right_limit - x, x - left_limit) / forehead_fade_mm;
    if (y < tip || (has_beard && y < eyes)) out = -1;
    const float down = (chin - y) / forehead_fade_mm;
    const float back = (ears - points[v][2]) / forehead_fade_mm;
    share[v] = std::clamp(std::max({up, out, down, back}), 0.0f, 1.0f);
  }
  return share;
}

// What a map shows of every vertex of the skin; 0 where nothing is known.
std::vector<Vec3f> seen_colours(const Mesh& mesh, const AlbedoMap& albedo) {
  std::vector<Vec3f> seen(mesh.points_mm.size(), Vec3f{0, 0, 0});
  const model::SkinAtlas atlas = model::make_skin_atlas(mesh);
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2f& uv = atlas.uvs[atlas.corners[t][i]];
      const int x = std::clamp(static_cast<int>(uv[0] * static_cast<float>(albedo.width)), 0, albedo.width - 1);
      const int y = std::clamp(static_cast<int>((1 - uv[1]) * static_cast<float>(albedo.height)), 0, albedo.height - 1);
      const Vec3f& colour = albedo.albedo[static_cast<std::size_t>(y) * static_cast<std::size_t>(albedo.width) +
                                          static_cast<std::size_t>(x)];
      if (colour[0] > 0) seen[atlas.triangles[t][i]] = colour;
    }
  return seen;
}

// How much more of each channel the cheeks reflect than the rig's own do there: for skin that no map shows.
std::array<double, 3> tone_of(const std::vector<Vec3f>& colours, const std::vector<Vec3f>& own,
                              const std::vector<float>& cheeks) {
  std::array<double, 3> tone = {1, 1, 1};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> ratios;
    for (std::size_t v = 0; v < colours.size(); ++v)
      if (colours[v][0] > 0 && cheeks[v] >= 0.5f)
        ratios.push_back(std::log(static_cast<double>(std::max(colours[v][c], least_albedo)) /
                                  static_cast<double>(std::max(own[v][c], least_albedo))));
    if (!ratios.empty()) tone[c] = std::exp(median(ratios));
  }
  return tone;
}

// How uncertain the colour, not the brightness, is that a fit's light leaves: a logarithm. Contrast near 0, as of a
// grey picture, or a dark one multiply what is read wrong.
double chroma_error(const FaceLight& light, const std::array<double, 3>& albedo) {
  double squares = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double lit = std::max(1e-3, model::light_at(light, c, 0.5) * albedo[c]);
    const double share = std::max(1e-3, std::abs(static_cast<double>(light.contrast) * light.gain[c]));
    const double error = reading_error / (share * srgb_slope(lit) * lit);
    squares += error * error / 3;
  }
  return std::sqrt(squares);
}

// Brings colours towards what the model's components say they are, by how uncertain they are; brightness stays.
void calm_colours(const MorphableModel& model, const FaceFit& fit, std::vector<Vec3f>& colours) {
  const std::vector<Vec3f> estimate = model::albedo_of(model, fit.albedo);
  std::array<double, 3> mean = {0, 0, 0};
  double count = 0;
  for (std::size_t v = 0; v < colours.size(); ++v) {
    if (colours[v][0] <= 0) continue;
    ++count;
    for (std::size_t c = 0; c < 3; ++c) mean[c] += static_cast<double>(estimate[v][c]);
  }
  if (count == 0) return;
  for (double& value : mean) value = std::max(0.01, value / count);
  const double error = chroma_error(fit.light, mean) / chroma_sigma, kept = 1 / (1 + error * error);
  for (std::size_t v = 0; v < colours.size(); ++v) {
    if (colours[v][0] <= 0) continue;
    std::array<double, 3> ratio{};
    double brighter = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      ratio[c] = std::log(static_cast<double>(std::max(colours[v][c], least_albedo)) /
                          static_cast<double>(std::max(estimate[v][c], least_albedo)));
      brighter += model::luma[c] * ratio[c];
    }
    for (std::size_t c = 0; c < 3; ++c)
      colours[v][c] = static_cast<float>(std::max(estimate[v][c], least_albedo) *
                                         std::exp(brighter + kept * (ratio[c] - brighter)));
  }
}

// Whether the chin is darker than the cheeks: stubble or a beard, whose sides are no hair that hangs over cheeks.
bool is_bearded(const MorphableModel& model, const Rig& person, const std::array<double, 3>& tone,
                const std::vector<Vec3f>& colours) {
  if (person.landmarks68.size() != 68) return false;
  const Vec3f chin = person.neutral.points_mm[person.landmarks68[8]];
  const Vec3f lip = person.neutral.points_mm[person.landmarks68[57]];
  std::vector<double> darker;
  for (std::size_t v = 0; v < colours.size(); ++v) {
    const Vec3f& p = person.neutral.points_mm[v];
    if (colours[v][0] <= 0 || std::abs(p[0] - chin[0]) > 25 || p[1] > lip[1] - 6 || p[1] < chin[1]) continue;
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c)
      sum += model::luma[c] * std::log(tone[c] * static_cast<double>(std::max(model.mean_albedo[v][c], least_albedo)) /
                                       static_cast<double>(std::max(colours[v][c], least_albedo)));
    darker.push_back(sum);
  }
  return median(darker) > beard_darker;
}

// Skin without hair over it, and its brightness brought towards the mean person's.
void put_right(const MorphableModel& model, const Rig& person, const NeutraliseOptions& options,
               std::vector<Vec3f>& colours) {
  const std::vector<float> cheeks = drawn_share(person);
  const std::array<double, 3> tone = tone_of(colours, model.mean_albedo, cheeks);
  const std::vector<float> hair = under_hair(person, is_bearded(model, person, tone, colours));
  double light = 0;
  for (std::size_t c = 0; c < 3; ++c) light += options.light_share * model::luma[c] * std::log(tone[c]);
  for (std::size_t v = 0; v < colours.size(); ++v) {
    Vec3f& colour = colours[v];
    if (colour[0] <= 0) continue;
    if (options.hair_contrast > 0 && hair[v] > 0) {
      std::array<double, 3> seen{}, skin{};
      double squares = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        seen[c] = std::log(static_cast<double>(std::max(colour[c], least_albedo)));
        skin[c] = std::log(tone[c] * static_cast<double>(std::max(model.mean_albedo[v][c], least_albedo)));
        squares += (seen[c] - skin[c]) * (seen[c] - skin[c]) / 3;
      }
      const double off = squares / (options.hair_contrast * options.hair_contrast);
      const double taken = static_cast<double>(hair[v]) * off / (1 + off);
      for (std::size_t c = 0; c < 3; ++c)
        colour[c] = static_cast<float>(std::exp(seen[c] + taken * (skin[c] - seen[c])));
    }
    for (float& value : colour) value *= static_cast<float>(std::exp(-light));
  }
}

// The skin outside the map, scalp and ears and neck, takes the tone of the cheeks.
void tone_rest(const std::vector<Vec3f>& own, const std::array<double, 3>& tone, const std::vector<Vec3f>& part_albedo,
               const std::vector<Vec3f>& colours, Mesh& mesh) {
  for (const Part& part : mesh.parts) {
    if (part.name != "head") continue;
    for (std::size_t i = mesh.polygon_starts[part.first_polygon];
         i < mesh.polygon_starts[part.first_polygon + part.polygon_count]; ++i) {
      const std::uint32_t v = mesh.corners[i];
      if (colours[v][0] > 0) continue;
      for (std::size_t c = 0; c < 3; ++c)
        mesh.colors_srgb[v][c] = static_cast<float>(
            std::clamp(srgb_of(std::min(1.0, tone[c] * static_cast<double>(own[v][c]) /
                                                 std::max(0.02, static_cast<double>(part_albedo[v][c])))),
                       0.0, 1.0));
    }
  }
}

}  // namespace

Rig neutralise(const MorphableModel& model, const Rig& rig, const FaceFit& fit, const AlbedoMap& albedo,
               const NeutraliseOptions& options) {
  check(rig.neutral.points_mm.size() == model.mean.points_mm.size(), "the rig has ", rig.neutral.points_mm.size(),
        " vertices, the model ", model.mean.points_mm.size());
  check(albedo.width > 0 && albedo.height > 0 &&
            albedo.albedo.size() == static_cast<std::size_t>(albedo.width) * static_cast<std::size_t>(albedo.height),
        "albedo has ", albedo.albedo.size(), " texels, expected ", albedo.width, " x ", albedo.height);
  Rig person = rig;
  person.neutral.points_mm = model::pose_model(model, fit.identity, {});
  Mesh& mesh = person.neutral;
  if (mesh.colors_srgb.size() != mesh.points_mm.size()) mesh.colors_srgb.assign(mesh.points_mm.size(), Vec3f{1, 1, 1});
  const render::SrgbTable srgb;
  std::vector<Vec3f> part_albedo(mesh.points_mm.size(), Vec3f{1, 1, 1});
  for (const Part& part : mesh.parts)
    for (std::size_t c = mesh.polygon_starts[part.first_polygon];
         c < mesh.polygon_starts[part.first_polygon + part.polygon_count]; ++c)
      for (std::size_t k = 0; k < 3; ++k) part_albedo[mesh.corners[c]][k] = srgb.linear(part.albedo_srgb[k]);
  const std::vector<Vec3f> own = model::vertex_albedo(mesh);
  std::vector<Vec3f> colours = seen_colours(mesh, albedo);
  calm_colours(model, fit, colours);
  put_right(model, person, options, colours);
  for (std::size_t v = 0; v < colours.size(); ++v)
    for (std::size_t c = 0; c < 3 && colours[v][0] > 0; ++c)
      mesh.colors_srgb[v][c] = static_cast<float>(
          std::clamp(srgb_of(std::min(1.0f, colours[v][c] / std::max(0.02f, part_albedo[v][c]))), 0.0, 1.0));
  tone_rest(own, tone_of(colours, own, drawn_share(person)), part_albedo, colours, mesh);
  return person;
}

}  // namespace face::texture
