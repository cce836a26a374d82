// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/head_rig.h"

#include "nodes/base/check.h"
#include "nodes/types/arkit.h"

namespace face::model {

Rig head_rig(const MorphableModel& model) {
  Rig rig;
  rig.neutral = model.mean;
  for (const std::string_view name : arkit_names) {
    rig.shapes.push_back({std::string(name), {}, {}});
    rig.missing.emplace_back(name);
  }
  const std::size_t vertices = model.mean.points_mm.size();
  const LinearSpace& space = model.expression;
  check(space.modes.size() == space.size() * vertices && space.names.size() == space.size(), "model has ", space.size(),
        " expressions, ", space.names.size(), " names and ", space.modes.size(), " offsets, expected a name each and ",
        vertices, " offsets");
  for (std::size_t k = 0; k < space.size(); ++k) {
    Shape shape{space.names[k], {}, {}};
    for (std::uint32_t v = 0; v < vertices; ++v) {
      Vec3f offset = space.modes[k * vertices + v];
      for (float& value : offset) value *= space.sigmas[k];
      if (offset == Vec3f{0, 0, 0}) continue;
      shape.vertices.push_back(v);
      shape.offsets_mm.push_back(offset);
    }
    rig.shapes.push_back(std::move(shape));
  }
  rig.inner_lips = model.inner_lips;
  rig.landmarks68 = model.landmarks68;
  return rig;
}

}  // namespace face::model
