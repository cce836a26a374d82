// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/flow/opencv_flow.h"
#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"
using namespace engine::declare;
using namespace face::flow;

NODE("flow.farneback", &farneback_flow, version{1},
     doc{"Polynomial expansion flow (Farneback 2003) by OpenCV, on one channel."},
     input{"reference", "The picture whose pixels are followed"}, input{"target", "The picture they are found in"},
     input{"start", "Displacements to begin with"},
     param("channel", &FarnebackFlowOptions::channel, "The channel that is compared: grey, radius, ..."),
     output("flow", "Displacement of every reference pixel"));
