// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/shape_rig.h"

#include "nodes/base/check.h"
#include "nodes/model/head_points.h"
#include "nodes/types/arkit.h"

namespace face::model {

Rig shape_rig(const MorphableModel& surface, const MeshPoints& shape, const Image* texture) {
  Rig rig;
  rig.neutral = surface.mean;
  rig.neutral.points_mm = head_points(surface, shape.points_mm);
  if (texture != nullptr) {
    const std::size_t skin = shape.points_mm.size();
    check(texture->channels == 3 && texture->pixels.size() == 3 * skin, "texture has ", texture->pixels.size(),
          " bytes, expected 3 for each of ", skin, " vertices");
    for (std::size_t v = 0; v < skin; ++v)
      for (std::size_t c = 0; c < 3; ++c)
        rig.neutral.colors_srgb[v][c] = static_cast<float>(texture->pixels[3 * v + c]) / 255;
  }
  for (const std::string_view name : arkit_names) {
    rig.shapes.push_back({std::string(name), {}, {}});
    rig.missing.emplace_back(name);
  }
  rig.inner_lips = surface.inner_lips;
  rig.landmarks68 = surface.landmarks68;
  return rig;
}

}  // namespace face::model
