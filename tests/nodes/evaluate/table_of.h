// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <stdexcept>
#include <string>

#include "nodes/types/table.h"

namespace test {

// A number of a table by the names of its row and column.
inline double cell(const face::Table& table, const std::string& row, const std::string& column) {
  for (const face::TableRow& r : table.rows) {
    if (r.name != row) continue;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (table.columns[c] == column) return r.values.at(c);
  }
  throw std::runtime_error("the table has no " + row + ", " + column);
}
inline double cell(const face::Table& table, const std::string& column) { return cell(table, "all", column); }

}  // namespace test
