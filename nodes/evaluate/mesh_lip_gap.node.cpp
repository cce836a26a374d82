// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/mesh_lip_gap.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.mesh_lip_gap", &mesh_lip_gap, version{1},
     doc{"evaluate.lip_gap for animations that are vertices instead of weights, counted from a truly closed mouth."},
     input{"rig", "The head whose mesh it is, with its inner lip pairs"},
     input{"points", "The vertices of every frame that are judged"},
     input{"truth", "The true ones; without them there is no comparison"},
     input{"closed", "The vertices with the mouth truly closed"}, input{"phones", "What is said when"},
     input{"timeline", "When every frame is shown"},
     param("closed_mm", &LipGapOptions::closed_mm, range{0.01, 20}, unit{"mm"},
           "Lip gap up to which a mouth is closed"),
     output("table", &LipGapResult::table, "Closures, penetration, false closures; own and truth"),
     output("frames", &LipGapResult::frames, "Lip gap of every frame; own and truth"));
