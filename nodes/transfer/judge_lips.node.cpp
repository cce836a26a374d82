// SPDX-License-Identifier: Apache-2.0
#include "nodes/transfer/judge_lips.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.judge_lips", &judge_lips, version{1},
     doc{"Whether vertices that were looked up on a head follow the right lip."},
     input{"places", "Where they were found, from transfer.look_up"},
     input{"truth", "Where they truly are, from transfer.scan_places"}, input{"head", "The head"},
     param("reach_mm", &JudgeLipsOptions::reach_mm, range{0.1, 1000.0}, unit{"mm"},
           "Vertices so near to the inner lips count"),
     output("table", "vertices, wrong, lost"));
