// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/scanned_rig.h"

#include "nodes/model/head_points.h"
#include "nodes/types/arkit.h"

namespace face::model {

Rig scanned_rig(const MorphableModel& surface, const engine::Seq<MeshPoints>& expressions, const MeshPoints& neutral,
                engine::SeqWriter<Weights>& poses) {
  Rig rig;
  rig.neutral = surface.mean;
  rig.neutral.points_mm = head_points(surface, neutral.points_mm);
  rig.landmarks68 = surface.landmarks68;
  rig.inner_lips = surface.inner_lips;
  for (const std::string_view name : arkit_names) {
    rig.shapes.push_back({std::string(name), {}, {}});
    rig.missing.emplace_back(name);
  }
  for (std::size_t i = 0; i < expressions.size(); ++i) {
    const std::vector<Vec3f> posed = head_points(surface, expressions.at(i)->points_mm);
    Shape shape{expressions.id(i), {}, {}};
    for (std::uint32_t v = 0; v < posed.size(); ++v) {
      Vec3f offset{};
      for (std::size_t k = 0; k < 3; ++k) offset[k] = posed[v][k] - rig.neutral.points_mm[v][k];
      if (offset == Vec3f{0, 0, 0}) continue;
      shape.vertices.push_back(v);
      shape.offsets_mm.push_back(offset);
    }
    rig.shapes.push_back(std::move(shape));
  }
  for (std::size_t i = 0; i < expressions.size(); ++i) {
    Weights weights{std::vector<float>(rig.shapes.size(), 0.0f)};
    weights.values[arkit_count + i] = 1;
    poses.push(expressions.id(i), std::move(weights));
  }
  return rig;
}

}  // namespace face::model
