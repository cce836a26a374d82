// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/export/export_mesh.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.ply", &export_ply, version{1},
     doc{"Writes a mesh, or a frame of its animation, as PLY, with its vertices in their order."},
     input{"mesh", "A mesh"}, input{"points", "Where its vertices are in a frame; without it they are the mesh's own"},
     param("unit", &ExportMeshOptions::unit, {{"m", ExportUnit::m}, {"cm", ExportUnit::cm}, {"mm", ExportUnit::mm}},
           "Unit of the lengths in the file"),
     output("file", "The .ply file"));
