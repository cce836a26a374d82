// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/start_flow.h"

#include "engine/node.h"
#include "nodes/types/depth_scan.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/landmarks.h"
using namespace engine::declare;
using namespace face::flow;

NODE("flow.start", &start_flow, version{1},
     doc{"Displacements to begin a flow with: the head's motion between two aligned scans, bent by markers."},
     input{"reference", "The scan whose pixels are followed"}, input{"target", "The scan they are found in"},
     input{"reference_markers", "Markers of the reference"}, input{"target_markers", "The same of the target"}, cheap{},
     param("reach_px", &StartFlowOptions::reach_px, range{1.0, 10000.0}, unit{"px"}, "How far a marker bends"),
     output("start", "Displacement of every measured reference pixel"));
