// SPDX-License-Identifier: Apache-2.0
#include "nodes/align/crop.h"
#include "engine/node.h"
using namespace engine::declare;
using namespace face::align;

NODE("align.crop", &crop, version{1}, cheap{},
     doc{"Leaves of a scan what lies within a mask in the cylindrical representation."},
     input{"scan", "An aligned scan"}, input{"axis", "Axis of the head"}, input{"mask", "From align.common_cover"},
     param("rows", &CoverOptions::rows, range{2, 10000}, unit{"1"}, "Rows of the grid"),
     param("columns", &CoverOptions::columns, range{2, 10000}, unit{"1"}, "Columns, over 180 degrees"),
     param("top_mm", &CoverOptions::top_mm, range{-10000.0, 10000.0}, unit{"mm"},
           "Height of the first row over the axis's origin"),
     param("step_mm", &CoverOptions::step_mm, range{0.01, 1000.0}, unit{"mm"}, "Height of a row"),
     output("cropped", "The scan within the mask"));
