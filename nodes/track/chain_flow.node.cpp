// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/chain_flow.h"

#include "engine/node.h"
#include "nodes/types/flow_field.h"
#include "nodes/types/landmarks.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.chain_flow", &chain_flow, version{1},
     doc{"Follows any set of points by stored flows; points that are put right go on from there by the same flows."},
     input{"flow", "From the previous frame to this one, from track.face_flow"},
     input{"from_first", "From the first frame to this one, against drift; without it flows are chained alone"},
     input{"start", "The points on the first frame"},
     input{"correction", "Points put right, for frames that have some"},
     param("names", &ChainFlowOptions::names, "Of the points that are followed; none = all of them"),
     param("lean_px", &ChainFlowOptions::lean_px, range{0.0, 100.0}, unit{"px"},
           "How far into lip or lid the points at a slit are followed"),
     param("half_size", &ChainFlowOptions::half_size, "Flows are of pictures of half the width and height"),
     param("pull", &ChainFlowOptions::pull, range{0.0, 1.0}, unit{"1"},
           "Share of the difference to the flow from the first frame that is taken back per frame"),
     param("max_pull_px", &ChainFlowOptions::max_pull_px, range{0.0, 1000.0}, unit{"px"},
           "Largest difference that is taken back"),
     output("landmarks", &ChainFlowResult::landmarks, "The points of each frame"),
     output("home", &ChainFlowResult::home, "Where each of them is on the first frame"),
     output("pulled_px", &ChainFlowResult::pulled_px,
            "Largest difference of the two flows at a point that was pulled"));
