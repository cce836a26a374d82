// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/join_tables.h"

#include <array>
#include <set>
#include <string>

#include "nodes/base/check.h"

namespace face::evaluate {

Table join_tables(const Table& first, const Table* second, const Table* third, const Table* fourth, const Table* fifth,
                  const Table* sixth, const Table* seventh, const Table* eighth) {
  Table joined;
  joined.columns = {"value"};
  std::set<std::string> taken;
  std::size_t number = 0;
  for (const Table* table : std::array<const Table*, 8>{&first, second, third, fourth, fifth, sixth, seventh, eighth}) {
    ++number;
    if (!table) continue;
    for (const TableRow& row : table->rows) {
      check(row.values.size() == table->columns.size(), "table ", number, ": row ", row.name, " has ",
            row.values.size(), " values, expected ", table->columns.size());
      for (std::size_t c = 0; c < row.values.size(); ++c) {
        std::string name = table->rows.size() > 1 ? row.name + "." + table->columns[c] : table->columns[c];
        if (!taken.insert(name).second) {
          name = std::to_string(number) + "." + name;
          taken.insert(name);
        }
        joined.rows.push_back({name, {row.values[c]}});
      }
    }
  }
  return joined;
}

}  // namespace face::evaluate
