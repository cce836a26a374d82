// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/image.h"
#include "nodes/types/mesh.h"
#include "nodes/types/rig.h"

namespace face::render {

// A mesh from the front and from its left, whole, as render_head lights it. A mesh without polygons is its vertices as
// dots (points_still).
Image mesh_still(const Mesh& mesh);

// A rig at rest from the front and from its left, and from the front with its jaw open by half and smiling.
Image rig_still(const Rig& rig);

}  // namespace face::render
