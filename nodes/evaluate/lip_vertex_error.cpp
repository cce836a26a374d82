// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/lip_vertex_error.h"

#include "nodes/evaluate/animations.h"
#include "nodes/evaluate/regions.h"

namespace face::evaluate {

LipVertexErrorResult lip_vertex_error(const Rig& rig, const engine::Seq<Weights>& weights,
                                      const engine::Seq<Weights>& truth, const VertexMask* lips,
                                      const LipVertexErrorOptions& options) {
  VertexErrors errors(rig, chosen_vertices(lips, rig.neutral.points_mm.size(), "lips",
                                           lips ? std::vector<std::uint32_t>() : lip_vertices(rig)));
  for_each_pose(rig, weights, truth, [&](std::size_t frame, const auto& points, const auto& true_points) {
    errors.add(weights.id(frame), points, true_points);
  });
  return errors.result(options.readable_mm, options.full_scale_mm);
}

}  // namespace face::evaluate
