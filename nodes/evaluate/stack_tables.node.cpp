// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/stack_tables.h"

#include "engine/node.h"
#include "nodes/types/table.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.stack_tables", &stack_tables, version{1},
     doc{"Puts the tables of many takes under each other, with the mean of all below."},
     input{"tables", "A table per take, all with the same columns"}, output("table", "All rows, then their means"));
