// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/leave_openings.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.leave_openings", &leave_openings, version{2},
     doc{"Takes lips' edges out of the opening that a scan shows between them."},
     input{"mesh", "Of the reference scan, from model.scan_mesh"},
     input{"shape", "Where its vertices are in the scan, from model.sample_scan"},
     input{"scan", "The aligned scan, its mouth open"},
     output("moved", "The shape, no edge of which lies in an opening"));
