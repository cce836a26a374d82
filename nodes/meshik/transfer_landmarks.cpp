// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/transfer_landmarks.h"

#include "nodes/base/check.h"
#include "nodes/meshik/landmark_vertices.h"

namespace face::meshik {

VertexTargets transfer_landmarks(const Rig& rig, const engine::Seq<Mesh>& key_meshes, const KeyShapes& key_shapes,
                                 const Weights& weights) {
  check(!key_shapes.shapes.empty(), "there are no key shapes");
  VertexTargets targets;
  if (weights.values.empty()) return targets;
  check(weights.values.size() == key_meshes.size(), "there are ", weights.values.size(), " weights, expected ",
        key_meshes.size(), ", one per key mesh");
  const std::size_t vertices = rig.neutral.points_mm.size();
  for (const LandmarkVertex& landmark : landmark_vertices(rig, key_shapes.shapes[0].landmarks)) {
    check(landmark.vertex < vertices, "a landmark is vertex ", landmark.vertex, ", expected one below ", vertices);
    const Vec3f& rest = rig.neutral.points_mm[landmark.vertex];
    VertexTarget target{landmark.vertex, static_cast<double>(rest[0]), static_cast<double>(rest[1]), 0, false};
    for (std::size_t k = 0; k < weights.values.size(); ++k) {
      const auto key = key_meshes.at(k);
      check(key->points_mm.size() == vertices, "key mesh ", key_meshes.id(k), " has ", key->points_mm.size(),
            " vertices, expected ", vertices);
      const auto weight = static_cast<double>(weights.values[k]);
      target.x_mm += weight * static_cast<double>(key->points_mm[landmark.vertex][0] - rest[0]);
      target.y_mm += weight * static_cast<double>(key->points_mm[landmark.vertex][1] - rest[1]);
    }
    targets.targets.push_back(target);
  }
  return targets;
}

}  // namespace face::meshik
