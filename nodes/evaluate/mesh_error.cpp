// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/mesh_error.h"

#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/regions.h"

namespace face::evaluate {

MeshErrorResult mesh_error(const Rig& rig, const engine::Seq<MeshPoints>& points, const engine::Seq<MeshPoints>& truth,
                           const VertexMask* lips, const MeshErrorOptions& options) {
  const std::size_t vertices = rig.neutral.points_mm.size();
  VertexErrors errors(rig,
                      chosen_vertices(lips, vertices, "lips", lips ? std::vector<std::uint32_t>() : lip_vertices(rig)));
  check_frame_counts(points.size(), truth.size(), "points", "truth");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto frame = points.at(i), true_frame = truth.at(i);
    if (frame->points_mm.empty()) {
      errors.lose(points.id(i));
      continue;
    }
    check_points(*frame, vertices, "points", points.id(i));
    check_points(*true_frame, vertices, "truth", truth.id(i));
    errors.add(points.id(i), frame->points_mm, true_frame->points_mm);
  }
  return errors.result(options.readable_mm, options.full_scale_mm);
}

}  // namespace face::evaluate
