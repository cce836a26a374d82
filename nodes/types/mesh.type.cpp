// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/mesh.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Mesh, "mesh", codec_version{1}, doc{"A polygon mesh in millimetres."}, field<&Mesh::points_mm>(),
     field<&Mesh::corners>(), field<&Mesh::polygon_starts>(), field<&Mesh::uvs>(), field<&Mesh::corner_uvs>(),
     field<&Mesh::colors_srgb>(),
     field<&Mesh::parts>(field<&Part::name>(), field<&Part::first_polygon>(), field<&Part::polygon_count>(),
                         field<&Part::albedo_srgb>(), field<&Part::gloss>(), field<&Part::visible>()),
     view{"png", "render.mesh_still"}, view{"obj", "export.obj"}, difference{"evaluate.mesh_difference"});
