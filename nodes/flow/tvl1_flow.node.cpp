// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/flow/opencv_flow.h"
#include "nodes/types/feature_map.h"
#include "nodes/types/flow_field.h"
using namespace engine::declare;
using namespace face::flow;

NODE("flow.tvl1", &tvl1_flow, version{1}, doc{"TV-L1 flow (Zach, Pock and Bischof 2007) by OpenCV, on one channel."},
     input{"reference", "The picture whose pixels are followed"}, input{"target", "The picture they are found in"},
     input{"start", "Displacements to begin with"},
     param("channel", &Tvl1FlowOptions::channel, "The channel that is compared: grey, radius, ..."),
     output("flow", "Displacement of every reference pixel"));
