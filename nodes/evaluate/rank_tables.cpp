// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/rank_tables.h"

#include <cmath>
#include <string>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {

Table rank_tables(const engine::Seq<Table>& tables) {
  check(!tables.empty(), "there are no tables to rank");
  Table ranked;
  std::vector<std::vector<double>> numbers;  // per column
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto table = tables.at(i);
    const std::string id = tables.id(i);
    if (i == 0) {
      ranked.columns = table->columns;
      numbers.resize(ranked.columns.size());
    }
    check(table->columns == ranked.columns, "table ", id, " has other columns than table ", tables.id(0));
    for (const TableRow& row : table->rows) {
      check(row.values.size() == ranked.columns.size(), "table ", id, ": row ", row.name, " has ", row.values.size(),
            " values, expected ", ranked.columns.size());
      ranked.rows.push_back({table->rows.size() > 1 ? id + "." + row.name : id, row.values});
      for (std::size_t c = 0; c < numbers.size(); ++c)
        if (!std::isnan(row.values[c])) numbers[c].push_back(row.values[c]);
    }
  }
  TableRow median{"median", {}}, p90{"p90", {}}, largest{"largest", {}};
  for (const std::vector<double>& column : numbers) {
    median.values.push_back(quantile(column, 0.5));
    p90.values.push_back(quantile(column, 0.9));
    largest.values.push_back(largest_of(column));
  }
  for (const TableRow& row : {median, p90, largest}) ranked.rows.push_back(row);
  return ranked;
}

}  // namespace face::evaluate
