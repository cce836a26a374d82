// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/truth_flow.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.truth_flow", &truth_flow, version{1},
     doc{"The true flow of a face between two frames, exact, with what is hidden marked as not valid."},
     input{"rig", "Head and its blend shapes"}, input{"reference", "What the reference frame shows"},
     input{"target", "What the target frame shows"}, input{"target_weights", "Blend-shape weights of the target"},
     input{"world_from_head", "Where the head is in the target; unconnected: at rest"},
     input{"camera", "Where the target is seen from"},
     param("tolerance_mm", &TruthFlowOptions::tolerance_mm, range{0.0, 100.0}, unit{"mm"},
           "A point this far behind what the target shows there is hidden"),
     output("flow", "Displacement of every reference pixel"));
