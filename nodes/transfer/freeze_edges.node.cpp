// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/transfer/move_model.h"
using namespace engine::declare;
using namespace face::transfer;

NODE("transfer.freeze_edges", &freeze_edges, version{1}, doc{"Holds the edge of a speaking face still."},
     input{"model", "The speaking model"}, input{"mesh", "Its mesh"},
     param("width_mm", &FreezeEdgesOptions::width_mm, range{0.0, 1000.0}, unit{"mm"},
           "How far from the outline motion has faded in"),
     output("frozen", "The model whose modes fade towards the outline"));
