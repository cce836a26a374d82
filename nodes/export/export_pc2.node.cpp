// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/export/export_points.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.pc2", &export_pc2, version{1},
     doc{"Writes the vertices of an animation as a point cache, which Blender's Mesh Cache modifier reads."},
     input{"points", "The vertices of every frame"},
     param("unit", &ExportPointsOptions::unit, {{"m", ExportUnit::m}, {"cm", ExportUnit::cm}, {"mm", ExportUnit::mm}},
           "Unit of the lengths in the file"),
     output("file", "The .pc2 file"));
