// SPDX-License-Identifier: Apache-2.0
#include "nodes/texture/neutralise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/model/light_model.h"
#include "nodes/model/pose_model.h"
#include "nodes/model/skin_atlas.h"
#include "nodes/model/skin_modes.h"
#include "nodes/render/shade.h"
#include "nodes/texture/draw_face.h"
#include "nodes/texture/uncover_skin.h"
#include "nodes/texture/vertex_graph.h"

namespace face::texture {
namespace {

constexpr double reading_error = 0.02;  // of a pixel's value: of light and picture together
constexpr double chroma_sigma = 0.2;    // of skin about what the model's components say, logarithm
constexpr float sure_weight = 0.12f;    // of a texel that is the picture's alone, as in texture.extract
constexpr double fade_outside = 1e-2;   // of what skin beside the map goes on from its edge: fades over some 20 mm
constexpr float least_albedo = 1e-3f;

// What a map shows of every vertex of the skin.
SeenSkin seen_skin(const Mesh& mesh, const AlbedoMap& albedo) {
  SeenSkin seen;
  seen.colour.assign(mesh.points_mm.size(), Vec3f{0, 0, 0});
  seen.sure.assign(mesh.points_mm.size(), 0.0f);
  const model::SkinAtlas atlas = model::make_skin_atlas(mesh);
  for (std::size_t t = 0; t < atlas.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2f& uv = atlas.uvs[atlas.corners[t][i]];
      const int x = std::clamp(static_cast<int>(uv[0] * static_cast<float>(albedo.width)), 0, albedo.width - 1);
      const int y = std::clamp(static_cast<int>((1 - uv[1]) * static_cast<float>(albedo.height)), 0, albedo.height - 1);
      const std::size_t texel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(albedo.width) + static_cast<std::size_t>(x);
      if (albedo.albedo[texel][0] <= 0) continue;
      seen.colour[atlas.triangles[t][i]] = albedo.albedo[texel];
      seen.sure[atlas.triangles[t][i]] = std::clamp(albedo.weight[texel] / sure_weight, 0.0f, 1.0f);
    }
  return seen;
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

// The skin outside the map, scalp and ears and neck, takes the tone of the cheeks, and goes on from the map's edge.
// colours: brightness as the person has it.
void continue_outside(const std::vector<Vec3f>& own, const std::vector<Vec3f>& part_albedo,
                      const std::vector<Vec3f>& colours, const std::array<double, 3>& tone, Mesh& mesh) {
  std::vector<bool> skin(colours.size());
  for (std::size_t v = 0; v < colours.size(); ++v) skin[v] = colours[v][0] > 0;
  for (const Part& part : mesh.parts)
    for (std::uint32_t c = mesh.polygon_starts[part.first_polygon];
         part.name == "head" && c < mesh.polygon_starts[part.first_polygon + part.polygon_count]; ++c)
      skin[mesh.corners[c]] = true;
  HarmonicFill fill;
  fill.value.resize(colours.size());
  fill.held.assign(colours.size(), 0.0);
  for (std::size_t v = 0; v < colours.size(); ++v) {
    if (colours[v][0] <= 0) continue;
    fill.held[v] = 1;
    for (std::size_t c = 0; c < 3; ++c)
      fill.value[v][c] = std::log(static_cast<double>(std::max(colours[v][c], least_albedo)) /
                                  (tone[c] * static_cast<double>(std::max(own[v][c], least_albedo))));
  }
  fill_harmonically(mesh_neighbours(mesh, skin), fade_outside, fill);
  for (std::size_t v = 0; v < colours.size(); ++v)
    for (std::size_t c = 0; c < 3 && skin[v]; ++c) {
      const double albedo =
          tone[c] * static_cast<double>(std::max(own[v][c], least_albedo)) * std::exp(fill.value[v][c]);
      mesh.colors_srgb[v][c] = static_cast<float>(std::clamp(
          srgb_of(std::min(1.0, albedo / std::max(0.02, static_cast<double>(part_albedo[v][c])))), 0.0, 1.0));
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
  SeenSkin seen = seen_skin(mesh, albedo);
  calm_colours(model, fit, seen.colour);
  std::vector<Vec3f> colours = uncover_skin(model, person, seen, options.hair_contrast);
  // A fit hardly tells a darker skin from a weaker light.
  const std::array<double, 3> tone = tone_of(colours, model.mean_albedo, drawn_share(person));
  double light = 0;
  for (std::size_t c = 0; c < 3; ++c) light += options.light_share * model::luma[c] * std::log(tone[c]);
  for (Vec3f& colour : colours)
    for (float& value : colour) value *= static_cast<float>(std::exp(-light));
  continue_outside(own, part_albedo, colours, tone_of(colours, own, drawn_share(person)), mesh);
  return person;
}

}  // namespace face::texture
