// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/transfer_landmarks.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/meshik/landmark_vertices.h"

namespace face::meshik {
namespace {

VertexTarget at_rest(const Rig& rig, std::uint32_t vertex) {
  const Vec3f& rest = rig.neutral.points_mm[vertex];
  return {vertex, static_cast<double>(rest[0]), static_cast<double>(rest[1]), 0, false};
}

// Moves targets at rest to where the weights blend their vertices, in front. Each mesh is asked for once: it may have
// to be read from a disk.
void blend(const Rig& rig, const engine::Seq<Mesh>& key_meshes, const Weights& weights,
           std::vector<VertexTarget>& targets) {
  for (std::size_t k = 0; k < weights.values.size(); ++k) {
    if (weights.values[k] == 0) continue;
    const auto key = key_meshes.at(k);
    check(key->points_mm.size() == rig.neutral.points_mm.size(), "key mesh ", key_meshes.id(k), " has ",
          key->points_mm.size(), " vertices, expected ", rig.neutral.points_mm.size());
    const auto weight = static_cast<double>(weights.values[k]);
    for (VertexTarget& target : targets) {
      const Vec3f &rest = rig.neutral.points_mm[target.vertex], &posed = key->points_mm[target.vertex];
      target.x_mm += weight * static_cast<double>(posed[0] - rest[0]);
      target.y_mm += weight * static_cast<double>(posed[1] - rest[1]);
    }
  }
}

}  // namespace

VertexTargets transfer_landmarks(const Rig& rig, const engine::Seq<Mesh>& key_meshes, const KeyShapes& key_shapes,
                                 const Weights& weights, const double* contact) {
  check(!key_shapes.shapes.empty(), "there are no key shapes");
  check(!contact || (*contact >= 0 && *contact <= 1), "contact is ", contact ? *contact : 0, ", expected 0 to 1");
  VertexTargets targets;
  if (weights.values.empty()) return targets;
  check(weights.values.size() == key_meshes.size(), "there are ", weights.values.size(), " weights, expected ",
        key_meshes.size(), ", one per key mesh");
  const std::size_t vertices = rig.neutral.points_mm.size();
  for (const LandmarkVertex& landmark : landmark_vertices(rig, key_shapes.shapes[0].landmarks)) {
    check(landmark.vertex < vertices, "a landmark is vertex ", landmark.vertex, ", expected one below ", vertices);
    targets.targets.push_back(at_rest(rig, landmark.vertex));
  }
  const bool meets = contact && *contact > 0;
  const auto target_of = [&](std::uint32_t vertex) {
    check(vertex < vertices, "an inner lip is vertex ", vertex, ", expected one below ", vertices);
    const auto same = [&](const VertexTarget& target) { return target.vertex == vertex; };
    const auto at = std::find_if(targets.targets.begin(), targets.targets.end(), same);
    if (at != targets.targets.end()) return static_cast<std::size_t>(at - targets.targets.begin());
    targets.targets.push_back(at_rest(rig, vertex));
    return targets.targets.size() - 1;
  };
  std::vector<std::pair<std::size_t, std::size_t>> lips;
  for (const LipPair& pair : rig.inner_lips) {
    if (!meets) break;
    const std::size_t upper = target_of(pair.upper), lower = target_of(pair.lower);
    lips.emplace_back(upper, lower);
  }
  blend(rig, key_meshes, weights, targets.targets);
  for (const auto& [upper, lower] : lips) {
    VertexTarget &above = targets.targets[upper], &below = targets.targets[lower];
    const auto gap_at_rest =
        static_cast<double>(rig.neutral.points_mm[above.vertex][1] - rig.neutral.points_mm[below.vertex][1]);
    const double open_mm = above.y_mm - below.y_mm - gap_at_rest;
    above.y_mm -= *contact * open_mm / 2;
    below.y_mm += *contact * open_mm / 2;
  }
  return targets;
}

}  // namespace face::meshik
