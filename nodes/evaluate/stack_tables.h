// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/table.h"

namespace face::evaluate {

// Puts the tables of many takes (or frames) under each other: rows "take" or, where a table has several, "take.row",
// then the mean of every kind of row over the takes that have a number there ("mean" or "mean.row"). All tables have
// the same columns.
Table stack_tables(const engine::Seq<Table>& tables);

}  // namespace face::evaluate
