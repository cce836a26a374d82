// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_depth.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.depth", &export_depth, version{1}, doc{"Writes a scan as a 16-bit depth picture and its picture."},
     input{"scan", "The scan"},
     param("depth_unit_mm", &ExportDepthOptions::depth_unit_mm, range{0.0001, 1000.0}, unit{"mm"},
           "Depth of one step of the 16 bits"),
     output("depth", &ExportDepthResult::depth, "The depth as .png; 0 = nothing measured"),
     output("picture", &ExportDepthResult::picture, "The picture as .png"));
