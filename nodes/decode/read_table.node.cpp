// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_table.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::decode;

NODE("decode.table", &read_table, version{1}, doc{"Reads a table of comma-separated values with a head line."},
     input{"file", "A .csv file"}, output("table", "Numbers with named rows and columns"));
