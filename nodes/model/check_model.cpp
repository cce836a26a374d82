// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/check_model.h"

#include "nodes/base/check.h"
#include "nodes/base/check_mesh.h"

namespace face::model {
namespace {

void check_space(const LinearSpace& space, const char* name, std::size_t vertices) {
  check(space.modes.size() == space.size() * vertices, "the model's ", space.size(), " ", name, " components have ",
        space.modes.size(), " offsets, expected ", vertices, " each");
}

}  // namespace

void check_model(const MorphableModel& model) {
  check_mesh(model.mean);
  const std::size_t vertices = model.mean.points_mm.size();
  check_space(model.identity, "identity", vertices);
  check_space(model.expression, "expression", vertices);
  check_space(model.albedo, "albedo", vertices);
  check(model.mean_albedo.size() == vertices, "the model has the albedo of ", model.mean_albedo.size(),
        " vertices, expected ", vertices);
  for (const std::uint32_t v : model.landmarks68)
    check(v < vertices, "a landmark of the model is vertex ", v, ", expected one below ", vertices);
  for (const LipPair& pair : model.inner_lips)
    check(pair.upper < vertices && pair.lower < vertices, "the model's lips meet at vertices ", pair.upper, " and ",
          pair.lower, ", expected ones below ", vertices);
}

}  // namespace face::model
