// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/export/length_unit.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"

namespace face::exports {

struct ExportMeshOptions {
  ExportUnit unit = ExportUnit::m;  // of the lengths in the file; Blender takes 1 for a metre
};

// Writes a mesh with its polygons as they are (quads stay quads), or one frame of its animation: points are its
// vertices then, as many; null = the mesh's own. Vertex order and count are the mesh's, so that a sequence of files has
// one topology. Numbers are the shortest ones that read back exactly.

// Wavefront OBJ: v (with colours behind the place where the mesh has some), vt, usemtl with the name of every part, f.
engine::File export_obj(const Mesh& mesh, const MeshPoints* points, const ExportMeshOptions& options = {});

// Binary little-endian PLY: x, y, z as float, red, green, blue as uchar where the mesh has colours, vertex_indices.
engine::File export_ply(const Mesh& mesh, const MeshPoints* points, const ExportMeshOptions& options = {});

// The vertices of a frame, or the mesh's own. Throws where they are not as many, or not finite.
const std::vector<Vec3f>& frame_points(const Mesh& mesh, const MeshPoints* points);

}  // namespace face::exports
