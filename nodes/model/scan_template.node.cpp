// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/scan_template.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.scan_template", &scan_template, version{2},
     doc{"The reference surface of scans around an axis: a mesh over a reference scan's skin, the mouth cut open, as a "
         "model whose spaces are empty."},
     input{"reference", "A scan with a half open mouth, or a closed one for identities"},
     input{"landmarks", "Its 68 points by Multi-PIE's numbers, in pixels of its picture"},
     param("row_step_px", &ScanTemplateOptions::row_step_px, range{1, 64}, unit{"px"}, "Rows from vertex to vertex"),
     param("column_step_px", &ScanTemplateOptions::column_step_px, range{1, 64}, unit{"px"},
           "Columns from vertex to vertex"),
     param("top_share", &ScanTemplateOptions::top_share, range{0.0, 5.0}, unit{"1"},
           "Reach above the brows, of the height from chin to brows"),
     param("bottom_share", &ScanTemplateOptions::bottom_share, range{0.0, 5.0}, unit{"1"}, "Reach below the chin"),
     param("half_angle_deg", &ScanTemplateOptions::half_angle_deg, range{10.0, 179.0}, unit{"deg"},
           "Reach to either side"),
     param("cap_tolerance", &ScanTemplateOptions::cap_tolerance, range{0.0, 765.0}, unit{"1"},
           "Difference to the forehead's colour, summed over three channels of 8 bits, at which a bathing cap begins; "
           "0 = there is none"),
     param("longest_edge_mm", &ScanTemplateOptions::longest_edge_mm, range{0.1, 1000.0}, unit{"mm"},
           "Longer edges are left out"),
     output("surface", "The mesh with its landmarks and pairs of the lips"));
