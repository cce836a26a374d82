// SPDX-License-Identifier: Apache-2.0
#include "nodes/mmm/settle_mouth.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::mmm;

NODE("mmm.settle_mouth", &settle_mouth, version{2},
     doc{"Puts the followed points of a mouth where its lips are: flow slides along edges and on even skin."},
     input{"reference", "The first frame"}, input{"start", "The points there: of the 68 of Multi-PIE"},
     input{"image", "A later frame"}, input{"landmarks", "The points as they were followed to it"},
     input{"depths_px", "How far start's points are towards the viewer, from meshik.landmark_depths"},
     param("rigid", &SettleMouthOptions::rigid, "Points that the jaw does not move"),
     param("flow_error_px", &SettleMouthOptions::flow_error_px, range{0.01, 100.0}, unit{"px"},
           "Error of a followed point of the lips where the picture tells its place"),
     param("lips_part_px", &SettleMouthOptions::lips_part_px, range{0.01, 100.0}, unit{"px"},
           "Error of where the lips are found to part"),
     output("landmarks", "The points, those of mouth and chin put right"));
