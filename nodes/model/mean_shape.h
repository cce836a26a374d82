// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/mesh_points.h"

namespace face::model {

// The mean of many, vertex by vertex. Throws where they differ in size, or there are none.
MeshPoints mean_shape(const engine::Seq<MeshPoints>& shapes);

}  // namespace face::model
