// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/mark_lips.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.mark_lips", &mark_lips, version{2},
     doc{"Tells a speaking model's rig where its lips meet, so that closure can be measured."},
     input{"rig", "From model.model_rig"}, input{"mesh", "From model.scan_mesh on the reference, whose lips are apart"},
     param("middle_share", &MarkLipsOptions::middle_share, range{0.01, 1.0}, unit{"1"},
           "Share of the mouth's width, about its middle, that is paired"),
     param("reach_mm", &MarkLipsOptions::reach_mm, range{0.1, 100.0}, unit{"mm"}, "How wide the lips are"),
     output("marked", &MarkLipsResult::marked, "The rig with its inner lip pairs"),
     output("lips", &MarkLipsResult::lips, "The vertices of the lips"),
     output("found", &MarkLipsResult::found, "False where the mesh has no opening of a mouth"));
