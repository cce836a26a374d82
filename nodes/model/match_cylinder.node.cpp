// SPDX-License-Identifier: Apache-2.0
#include "nodes/model/match_cylinder.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::model;

NODE("model.match_cylinder", &match_cylinder, version{2},
     doc{"A surface's vertices in a scan around an axis, by the flow from a combination's picture to it; what the flow "
         "does not reach is filled in."},
     input{"surface", "The reference surface"}, input{"start", "The combination that the flow began with"},
     input{"drawn", "Its picture (model.draw_cylinder)"}, input{"target", "The scan"},
     input{"flow", "Displacement of every pixel of drawn"},
     param("outlier_mm", &MatchCylinderOptions::outlier_mm, range{0.01, 1000.0}, unit{"mm"},
           "A vertex that moves so far otherwise than those about it is filled in"),
     output("shape", &MatchCylinderResult::shape, "The skin's vertices in the scan"),
     output("texture", &MatchCylinderResult::texture, "Their colours, one row"),
     output("sampled", &MatchCylinderResult::sampled, "Share of the vertices that were found"));
