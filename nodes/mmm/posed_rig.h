// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"

namespace face::mmm {

// A head with other vertices at rest and no shapes: a solved frame as what renders, exports and measures take.
Rig posed_rig(const Rig& rig, const MeshPoints& points);

}  // namespace face::mmm
