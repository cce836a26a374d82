// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/join_tables.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.join_tables", &join_tables, version{1},
     doc{"Puts up to eight small tables of metrics into one, a row per number."}, input{"first", "A table"},
     input{"second", "Another"}, input{"third", "Another"}, input{"fourth", "Another"}, input{"fifth", "Another"},
     input{"sixth", "Another"}, input{"seventh", "Another"}, input{"eighth", "Another"},
     output("table", "A row per number, named after its column and row"));
