// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/decode/length_unit.h"
#include "nodes/types/mesh.h"
#include "nodes/types/mesh_points.h"
#include "nodes/types/rig.h"

namespace face::decode {

struct ReadMeshOptions {
  LengthUnit unit = LengthUnit::automatic;  // of the lengths in the file
};

struct ReadMeshResult {
  Mesh mesh;          // in mm, vertices in the file's order
  MeshPoints points;  // its vertices alone, as frames of an animation have them
};

// Reads a mesh: PLY (ascii or binary; FLAME, COMA and VOCASET write binary ones in metres) or OBJ, told by the suffix,
// else by how the file begins. Vertices keep the file's order, so that files of one topology (a registration per frame)
// go together; of an OBJ each material becomes a part. Other formats are named in the error, with what would serve.
ReadMeshResult read_mesh(const engine::File& file, const ReadMeshOptions& options = {});

// The mesh of a head at rest.
Mesh rig_mesh(const Rig& rig);

}  // namespace face::decode
