// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "engine/port.h"
#include "nodes/types/table.h"

namespace face::decode {

// Reads a table of comma-separated values (RFC 4180) with a head line, as export.table and spreadsheets write it. A
// column whose cells are numbers or empty is a column of the table (empty = NaN, "inf" is read too); the cells of the
// others, joined by a blank, are the row's name; without any the name is the row's number, from 0. A byte order mark is
// dropped. Throws with file and line where rows have unequal lengths, where a quote is not closed, and where columns
// have no names.
Table read_table(const engine::File& file);

}  // namespace face::decode
