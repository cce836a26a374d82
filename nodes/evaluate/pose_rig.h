// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"
#include "nodes/types/weights.h"

namespace face::evaluate {

// The vertices of a rig at given weights, as metrics of meshes take them.
MeshPoints pose_rig(const Rig& rig, const Weights& weights);

}  // namespace face::evaluate
