// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/model/sample_scan.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.scan_mesh", &scan_mesh, version{3}, doc{"The mesh of a reference scan."},
     input{"reference", "The reference scan, cropped"},
     param("stride_px", &ScanMeshOptions::stride_px, range{1, 100}, unit{"px"}, "Distance of the vertices"),
     param("longest_edge_mm", &ScanMeshOptions::longest_edge_mm, range{0.1, 1000.0}, unit{"mm"},
           "Triangles with a longer edge are left out"),
     output("mesh", "Its vertices are the shape vectors'"));
