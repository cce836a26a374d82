// SPDX-License-Identifier: Apache-2.0
#include "nodes/decode/read_table.h"

#include <charconv>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/decode/input_file.h"

namespace face::decode {
namespace {

struct Row {
  std::vector<std::string> cells;
  std::size_t line = 0;
};

std::vector<Row> rows_of(const std::string& text, const std::string& title) {
  std::vector<Row> rows;
  std::size_t line = 1;
  Row row{{""}, 1};
  bool quoted = false, any = false;
  const auto end_row = [&] {
    if (any || row.cells.size() > 1) rows.push_back(std::move(row));
    row = {{""}, line};
    any = false;
  };
  for (std::size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (quoted) {
      if (c == '"' && i + 1 < text.size() && text[i + 1] == '"')
        row.cells.back() += text[++i];
      else if (c == '"')
        quoted = false;
      else
        row.cells.back() += c;
    } else if (c == '"' && row.cells.back().empty()) {
      quoted = any = true;
    } else if (c == ',') {
      row.cells.emplace_back();
    } else if (c == '\n') {
      end_row();
    } else if (c != '\r') {
      row.cells.back() += c;
      any = true;
    }
  }
  check(!quoted, title, ":", row.line, ": found a quote that is not closed");
  end_row();
  return rows;
}

bool number_of(const std::string& cell, double& value) {
  value = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty()) return true;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && stop == cell.data() + cell.size();
}

}  // namespace

Table read_table(const engine::File& file) {
  const std::string title = title_of(file), suffix = lower_suffix(file);
  check(suffix == ".csv" || suffix == ".txt", title, ": found the suffix \"", file.suffix(),
        "\", expected .csv: comma-separated values with a head line");
  const std::vector<Row> rows = rows_of(read_bytes(file), title);
  check(!rows.empty(), title, ": is empty, expected a head line");
  const std::vector<std::string>& head = rows[0].cells;
  std::vector<bool> numeric(head.size(), true);
  double value = 0;
  for (std::size_t c = 0; c < head.size(); ++c) check(!head[c].empty(), title, ":1: column ", c + 1, " has no name");
  for (std::size_t r = 1; r < rows.size(); ++r) {
    check(rows[r].cells.size() == head.size(), title, ":", rows[r].line, ": found ", rows[r].cells.size(),
          " cells, expected ", head.size(), ", as the head line has");
    for (std::size_t c = 0; c < head.size(); ++c) numeric[c] = numeric[c] && number_of(rows[r].cells[c], value);
  }
  if (head[0] == "name") numeric[0] = false;  // as export.table calls them
  Table table;
  for (std::size_t c = 0; c < head.size(); ++c)
    if (numeric[c]) table.columns.push_back(head[c]);
  const bool named = table.columns.size() < head.size();
  for (std::size_t r = 1; r < rows.size(); ++r) {
    TableRow row{named ? "" : std::to_string(r - 1), {}};
    for (std::size_t c = 0; c < head.size(); ++c) {
      if (numeric[c]) {
        number_of(rows[r].cells[c], value);
        row.values.push_back(value);
      } else {
        row.name += (row.name.empty() ? "" : " ") + rows[r].cells[c];
      }
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace face::decode
