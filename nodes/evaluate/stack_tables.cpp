// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/stack_tables.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {

Table stack_tables(const engine::Seq<Table>& tables) {
  check(!tables.empty(), "there are no tables to stack");
  Table stacked;
  std::map<std::string, std::vector<std::vector<double>>> kinds;  // numbers per column
  std::vector<std::string> order;
  std::size_t index = 0;
  for (const Table& table : tables) {
    const std::string id = tables.id(index++);
    if (index == 1) stacked.columns = table.columns;
    check(table.columns == stacked.columns, "table ", id, " has other columns than table ", tables.id(0));
    for (const TableRow& row : table.rows) {
      check(row.values.size() == table.columns.size(), "table ", id, ": row ", row.name, " has ", row.values.size(),
            " values, expected ", table.columns.size());
      const std::string kind = table.rows.size() > 1 ? "." + row.name : "";
      stacked.rows.push_back({id + kind, row.values});
      const auto [entry, is_new] = kinds.try_emplace(kind, row.values.size());
      if (is_new) order.push_back(kind);
      for (std::size_t c = 0; c < row.values.size(); ++c)
        if (!std::isnan(row.values[c])) entry->second[c].push_back(row.values[c]);
    }
  }
  for (const std::string& kind : order) {
    TableRow row{"mean" + kind, {}};
    for (const std::vector<double>& column : kinds[kind]) row.values.push_back(mean_of(column));
    stacked.rows.push_back(row);
  }
  return stacked;
}

}  // namespace face::evaluate
