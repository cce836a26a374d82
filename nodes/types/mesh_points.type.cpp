// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/mesh_points.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(MeshPoints, "mesh_points", codec_version{1}, doc{"Where the vertices of a mesh are in one frame."},
     field<&MeshPoints::points_mm>(), view{"png", "render.points_still"}, difference{"evaluate.points_difference"});
