// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/vertex_mask.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(VertexMask, "vertex_mask", codec_version{1}, doc{"A yes or no for every vertex of a mesh."},
     field<&VertexMask::on>());
