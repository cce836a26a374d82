// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/export/export_points.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.points_npy", &export_points_npy, version{1},
     doc{"Writes the vertices of an animation as an array of NumPy: frames x vertices x 3."},
     input{"points", "The vertices of every frame"},
     param("unit", &ExportPointsOptions::unit, {{"m", ExportUnit::m}, {"cm", ExportUnit::cm}, {"mm", ExportUnit::mm}},
           "Unit of the lengths in the file"),
     output("file", "The .npy file"));
