// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace face {

struct TableRow {
  std::string name;            // of what was measured: a frame, a region, a metric
  std::vector<double> values;  // one per column; NaN where it was not measured
};

// A small table of numbers with named rows and columns (units in the columns' names).
struct Table {
  std::vector<std::string> columns;
  std::vector<TableRow> rows;
};

}  // namespace face
