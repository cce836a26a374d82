// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/mesh_space.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(MeshSpace, "mesh_space", codec_version{1}, doc{"Example poses of a mesh, ready to be blended by MeshIK."},
     field<&MeshSpace::vertex_count>(), field<&MeshSpace::example_count>(), field<&MeshSpace::triangles>(),
     field<&MeshSpace::frames>(), field<&MeshSpace::gradients>(), field<&MeshSpace::blends>(),
     field<&MeshSpace::component>(), field<&MeshSpace::centroids_mm>(), field<&MeshSpace::order>(),
     field<&MeshSpace::column_starts>(), field<&MeshSpace::rows>(), field<&MeshSpace::values>());
