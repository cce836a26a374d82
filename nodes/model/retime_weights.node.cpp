// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/retime_weights.h"

#include "engine/node.h"
#include "nodes/types/timeline.h"
#include "nodes/types/weights.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.retime_weights", &retime_weights, version{1}, cheap{},
     doc{"Weights for every frame of a clip, from weights at another rate."},
     input{"weights", "Weights, one per moment of their timeline"}, input{"timeline", "Their moments"},
     input{"clip", "The clip's frames"},
     param("delay_s", &RetimeWeightsOptions::delay_s, range{-60, 60}, unit{"s"}, "Of the weights against the clip"),
     output("retimed", "Weights, one per frame of the clip"));
