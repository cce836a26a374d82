// SPDX-License-Identifier: Apache-2.0
#include "nodes/flow/robust_flow.h"

#include "engine/node.h"
#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"
using namespace engine::declare;
using namespace face::flow;

NODE("flow.robust", &robust_flow, version{1},
     doc{"Dense optical flow with robust data and smoothness terms (Black and Anandan 1996)."},
     input{"reference", "The picture whose pixels are followed"}, input{"target", "The picture they are found in"},
     input{"start", "Displacements to begin with"},
     param("levels", &RobustFlowOptions::levels, range{1, 10}, unit{"1"}, "Pyramid levels"),
     param("coarse_warps", &RobustFlowOptions::coarse_warps, range{1, 50}, unit{"1"},
           "Linearisations on every level but the finest"),
     param("fine_warps", &RobustFlowOptions::fine_warps, range{1, 50}, unit{"1"}, "Linearisations on the finest level"),
     param("smoothness", &RobustFlowOptions::smoothness, range{0.0, 1e6}, unit{"1"},
           "Weight of the smoothness term, per squared unit of the channel"),
     param("data_scale", &RobustFlowOptions::data_scale, range{1e-6, 1e6}, unit{"1"},
           "Sigma of the data term in the channel's unit: larger differences are outliers"),
     param("smooth_scale_px", &RobustFlowOptions::smooth_scale_px, range{1e-6, 1000.0}, unit{"px"},
           "Sigma of the smoothness term: neighbours that differ more are at an edge of motion"),
     param("first_looseness", &RobustFlowOptions::first_looseness, range{1.0, 100.0}, unit{"1"},
           "How many times larger both sigmas start on every level"),
     param("remove_spikes", &RobustFlowOptions::remove_spikes, "Replaces single wild pixels first"),
     output("flow", "Displacement of every reference pixel"));
