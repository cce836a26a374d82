// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/evaluate/vertex_errors.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"
#include "nodes/types/vertex_mask.h"

namespace face::evaluate {

struct MeshErrorOptions {
  double readable_mm = 2;
  double full_scale_mm = 5;
};

using MeshErrorResult = VertexErrorResult;

// lip_vertex_error for animations that are given as vertices. points, truth: as many frames, V x 3 each, V as the
// rig's. A frame without any points was lost (its face was not seen): it is not valid and does not count.
MeshErrorResult mesh_error(const Rig& rig, const engine::Seq<MeshPoints>& points, const engine::Seq<MeshPoints>& truth,
                           const VertexMask* lips, const MeshErrorOptions& options = {});

}  // namespace face::evaluate
