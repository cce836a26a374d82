// SPDX-License-Identifier: Apache-2.0
#include "nodes/phantom/lose_points.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::phantom;

NODE("phantom.lose_points", &lose_points, version{1},
     doc{"Which points a scanner with incremental update has lost: those that were out of sight of its camera or its "
         "projector once since the beginning of the take."},
     input{"rig", "Head and its blend shapes"}, input{"weights", "Blend-shape weights of the frame"},
     input{"world_from_head", "Where the head is; unconnected: at rest"}, input{"camera", "The scanner's camera"},
     input{"projector", "The scanner's projector"},
     param("width_px", &LosePointsOptions::width_px, range{1, 4096}, unit{"px"}, "Width of the scan"),
     param("height_px", &LosePointsOptions::height_px, range{1, 4096}, unit{"px"}, "Height of the scan"),
     param("projector_width_px", &LosePointsOptions::projector_width_px, range{1, 4096}, unit{"px"},
           "Width of the projector's picture"),
     param("projector_height_px", &LosePointsOptions::projector_height_px, range{1, 4096}, unit{"px"}, "Its height"),
     param("share", &LosePointsOptions::share, range{0.0, 1.0}, unit{"1"},
           "How much of what goes out of sight is lost; 0 switches it off"),
     param("seed", &LosePointsOptions::seed, range{0, 1000000}, unit{"1"}, "Another seed loses other patches"),
     output("lost", &LosePointsResult::lost, "Lost vertices"));
