// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/evaluate/vertex_errors.h"
#include "nodes/types/rig.h"
#include "nodes/types/vertex_mask.h"
#include "nodes/types/weights.h"

namespace face::evaluate {

struct LipVertexErrorOptions {
  double readable_mm = 2;    // a frame whose worst lip vertex is no farther off counts as readable
  double full_scale_mm = 5;  // of the heat map
};

using LipVertexErrorResult = VertexErrorResult;

// Compares two animations of one rig vertex by vertex; VertexErrors has the definitions. weights, truth: as many
// frames. lips: V; null = lip_vertices(rig).
LipVertexErrorResult lip_vertex_error(const Rig& rig, const engine::Seq<Weights>& weights,
                                      const engine::Seq<Weights>& truth, const VertexMask* lips,
                                      const LipVertexErrorOptions& options = {});

}  // namespace face::evaluate
