// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/lip_gap.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.lip_gap", &lip_gap, version{1},
     doc{"Whether lips close in every P B M, touch the teeth in every F V, stay open in open vowels and never run into "
         "each other; with the gap of every frame."},
     input{"rig", "The head that is animated"}, input{"weights", "The animation that is judged"},
     input{"truth", "The true weights; without it there is no comparison"}, input{"phones", "What is said when"},
     input{"timeline", "When every frame is shown"},
     param("closed_mm", &LipGapOptions::closed_mm, range{0.01, 20}, unit{"mm"},
           "Lip gap up to which a mouth is closed"),
     output("table", &LipGapResult::table, "Closures, penetration, false closures, lip on teeth; own and truth"),
     output("frames", &LipGapResult::frames, "Lip gap of every frame; own and truth"));
