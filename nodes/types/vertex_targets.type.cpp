// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/vertex_targets.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(VertexTargets, "vertex_targets", codec_version{1}, doc{"Places that vertices of a mesh have to take."},
     field<&VertexTargets::targets>(field<&VertexTarget::vertex>(), field<&VertexTarget::x_mm>(),
                                    field<&VertexTarget::y_mm>(), field<&VertexTarget::z_mm>(),
                                    field<&VertexTarget::has_z>()));
