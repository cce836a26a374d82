// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/project_cylinder.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.project_cylinder", &project_cylinder, version{2},
     doc{"A frame of a speaking model around its axis: radius and grey over height and angle."},
     input{"mesh", "From model.scan_mesh"}, input{"shape", "Where its vertices are in the frame"},
     input{"axis", "From align.fit_axis"},
     param("columns", &ProjectCylinderOptions::columns, range{8, 8192}, unit{"1"}, "Steps of the full turn"),
     param("step_mm", &ProjectCylinderOptions::step_mm, range{0.05, 100.0}, unit{"mm"}, "From row to row"),
     output("scan", &ProjectCylinderResult::scan, "Radius and grey, as a laser scanner makes them"),
     output("marks", &ProjectCylinderResult::marks, "Tip of the nose and corners of the mouth in its picture"));
