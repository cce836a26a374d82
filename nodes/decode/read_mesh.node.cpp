// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_mesh.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.mesh", &read_mesh, version{1},
     doc{"Reads a mesh: PLY (FLAME, COMA and VOCASET too) or OBJ, with its vertices in the file's order."},
     input{"file", "A .ply or .obj file"},
     param("unit", &ReadMeshOptions::unit,
           {{"automatic", LengthUnit::automatic}, {"mm", LengthUnit::mm}, {"cm", LengthUnit::cm}, {"m", LengthUnit::m}},
           "Unit of the lengths in the file; automatic goes by the size of the mesh"),
     output("mesh", &ReadMeshResult::mesh, "The mesh in mm"),
     output("points", &ReadMeshResult::points, "Its vertices alone, as frames of an animation have them"));
