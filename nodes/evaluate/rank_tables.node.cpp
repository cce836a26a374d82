// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/rank_tables.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.rank_tables", &rank_tables, version{1},
     doc{"Puts tables under each other, with median, 90th percentile and largest of every column below."},
     input{"tables", "Tables with the same columns"}, output("table", "All rows, then median, p90 and largest"));
