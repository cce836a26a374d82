// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/flow.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;

NODE("evaluate.flow", &face::evaluate::flow, version{1},
     doc{"Endpoint error of optical flow: mean, p95, share above 1 px."},
     input{"flow", "The flow of every frame that is judged"}, input{"truth", "The true one"},
     output("table", &face::evaluate::FlowResult::table, "epe_mean_px, epe_p95_px, over_1px_percent, valid_percent"),
     output("frames", &face::evaluate::FlowResult::frames, "The same per frame"));
