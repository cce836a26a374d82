// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "nodes/types/table.h"

namespace face::evaluate {

// Puts small tables of different columns into one that reads from top to bottom: a row per number with the column
// "value", named after its column, and after its row where a table has several ("own.closure_percent"). Null tables are
// left out. A name that comes twice gets the number of its table ("2.offset_ms").
Table join_tables(const Table& first, const Table* second, const Table* third, const Table* fourth, const Table* fifth,
                  const Table* sixth, const Table* seventh, const Table* eighth);

}  // namespace face::evaluate
