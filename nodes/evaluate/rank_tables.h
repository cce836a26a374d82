// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/table.h"

namespace face::evaluate {

// The rows of tables with the same columns under each other, and below them over all rows the median, the 90th
// percentile and the largest of every column; numbers that are NaN are left out. Rows of a table with one row are
// named by the table's id, others ID.ROW. Throws where there is no table, or their columns differ.
Table rank_tables(const engine::Seq<Table>& tables);

}  // namespace face::evaluate
