// SPDX-License-Identifier: Apache-2.0
#include "engine/node.h"
#include "nodes/evaluate/number_differences.h"
using namespace engine::declare;
using namespace face::evaluate;

NODE("evaluate.table_difference", &table_difference, version{1}, doc{"How two tables of numbers differ, cell by cell."},
     input{"a", "A table"}, input{"b", "Another"},
     output("table",
            "Row all: the largest difference, counts of what only one has, and of each column; then b - a of rows that "
            "differ"));
