// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/mark_lips.h"

#include <cmath>

#include "nodes/base/check.h"
#include "nodes/transfer/lip_sides.h"
#include "nodes/transfer/mesh_graph.h"

namespace face::transfer {

MarkLipsResult mark_lips(const Rig& rig, const Mesh& mesh, const MarkLipsOptions& options, engine::Progress& progress) {
  check(rig.neutral.points_mm.size() == mesh.points_mm.size(), "rig has ", rig.neutral.points_mm.size(),
        " vertices, the mesh ", mesh.points_mm.size());
  const MouthOpening mouth = find_mouth_opening(mesh);
  MarkLipsResult result{rig, {std::vector<std::uint8_t>(mesh.points_mm.size(), 0)}, mouth.found()};
  if (!mouth.found()) {
    progress.warn(
        message("the reference's mesh of ", mesh.points_mm.size(),
                " points has no opening of a mouth: take a reference whose lips are farther apart (openness), "
                "and see in the review that its mouth was cleared"));
    return result;
  }
  const auto x_of = [&](std::uint32_t v) { return static_cast<double>(mesh.points_mm[v][0]); };
  const double middle = 0.5 * (x_of(mouth.right_corner) + x_of(mouth.left_corner));
  const double half = 0.5 * options.middle_share * (x_of(mouth.left_corner) - x_of(mouth.right_corner));
  result.marked.inner_lips.clear();
  for (const std::uint32_t u : mouth.upper) {
    if (std::fabs(x_of(u) - middle) > half) continue;
    std::uint32_t nearest = mouth.lower.front();
    for (const std::uint32_t l : mouth.lower)
      if (std::fabs(x_of(l) - x_of(u)) < std::fabs(x_of(nearest) - x_of(u))) nearest = l;
    result.marked.inner_lips.push_back({u, nearest});
  }
  std::vector<std::uint32_t> edge = mouth.upper;
  edge.insert(edge.end(), mouth.lower.begin(), mouth.lower.end());
  const std::vector<float> distance =
      distances_from(neighbours_of(mesh), mesh.points_mm, edge, static_cast<float>(options.reach_mm));
  for (std::size_t v = 0; v < distance.size(); ++v) result.lips.on[v] = std::isfinite(distance[v]) ? 1 : 0;
  return result;
}

}  // namespace face::transfer
