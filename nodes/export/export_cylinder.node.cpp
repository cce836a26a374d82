// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_cylinder.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.cylinder", &export_cylinder, version{1},
     doc{"Writes a laser scan around an axis as decode.cylinder_scan reads it: two pictures and a header."},
     input{"scan", "A scan around an axis"},
     param("radius_unit_mm", &ExportCylinderOptions::radius_unit_mm, range{0.0001, 100.0}, unit{"mm"},
           "What a step of the 16 bits stands for"),
     output("header", &ExportCylinderResult::header, "The header, JSON"),
     output("radius", &ExportCylinderResult::radius, "Radii, PNG of 16 bits"),
     output("colour", &ExportCylinderResult::colour, "Colours, PNG"));
