// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_table.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::exports;

NODE("export.table", &export_table, version{1}, doc{"Writes a table of numbers as CSV or JSON."},
     input{"table", "Numbers with named rows and columns"},
     param("format", &ExportTableOptions::format, {{"csv", TableFormat::csv}, {"json", TableFormat::json}},
           "For spreadsheets, or for scripts"),
     output("file", "The .csv or .json file"));
