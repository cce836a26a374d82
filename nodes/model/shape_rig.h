// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/morphable_model.h"
#include "nodes/types/rig.h"

namespace face::model {

// A scanned shape as a head to look at: the skin in this shape, teeth and inner mouth going along, the colours of a
// texture (RGB, one row; null = the surface's own). Its 52 ARKit shapes are empty and named in `missing`.
Rig shape_rig(const MorphableModel& surface, const MeshPoints& shape, const Image* texture);

}  // namespace face::model
