// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/add_albedo.h"

#include <utility>

#include "nodes/base/check.h"
#include "nodes/base/check_mesh.h"
#include "nodes/model/from_rig.h"
#include "nodes/model/skin_modes.h"

namespace face::model {
namespace {

constexpr Vec3f usual_skin_srgb = {0.80f, 0.62f, 0.53f};

}  // namespace

MorphableModel add_albedo(const MorphableModel& model, const AddAlbedoOptions& options) {
  check_mesh(model.mean);
  check(!model.mean.points_mm.empty() && model.mean.polygon_starts.size() > 1, "the model has no polygons");
  const std::size_t vertices = model.mean.points_mm.size();
  check(model.mean_albedo.empty() || model.mean_albedo.size() == vertices, "the model has the albedo of ",
        model.mean_albedo.size(), " vertices, expected ", vertices);
  for (const std::uint32_t v : model.landmarks68)
    check(v < vertices, "a landmark of the model is vertex ", v, ", expected one below ", vertices);
  if (!model.mean_albedo.empty() && model.albedo.size() > 0) return model;
  MorphableModel result = model;
  if (!model.mean_albedo.empty()) {
    result.albedo =
        skin_modes(model.mean, model.mean_albedo, model.landmarks68, static_cast<std::size_t>(options.albedos));
    return result;
  }
  Rig rig;
  rig.neutral = model.mean;
  rig.landmarks68 = model.landmarks68;
  if (rig.neutral.parts.empty()) {
    Part face;
    face.name = "face";
    face.albedo_srgb = usual_skin_srgb;
    face.polygon_count = static_cast<std::uint32_t>(rig.neutral.polygon_starts.size() - 1);
    rig.neutral.parts.push_back(std::move(face));
  }
  FromRigOptions made;
  made.albedos = options.albedos;
  made.skins = options.skins;
  made.seed = options.seed;
  add_made_skins(rig, made, result);
  return result;
}

}  // namespace face::model
