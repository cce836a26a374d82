// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/table.h"

namespace face::exports {

enum class TableFormat { csv, json };

struct ExportTableOptions {
  TableFormat format = TableFormat::csv;
};

// Writes a table for spreadsheets and scripts. csv: a line with "name" and the columns, then a line per row; fields
// with a comma or a quote are quoted (RFC 4180); a number that was not measured is an empty field. json:
// {"columns": [...], "rows": {"name": [...], ...}} in the table's order; what JSON has no number for is null. Numbers
// are the shortest ones that read back exactly; infinity is "inf" in csv.
engine::File export_table(const Table& table, const ExportTableOptions& options = {});

}  // namespace face::exports
