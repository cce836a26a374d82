// SPDX-License-Identifier: Apache-2.0
#include "nodes/export/export_table.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>

#include "nodes/base/check.h"
#include "nodes/export/csv.h"

namespace face::exports {
namespace {

void append_shortest(std::string& out, double value) {
  if (std::isnan(value)) return;
  char text[40];
  out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string csv_of(const Table& table) {
  std::string text = "name";
  for (const std::string& column : table.columns) text += ',', append_field(text, column);
  text += '\n';
  for (const TableRow& row : table.rows) {
    append_field(text, row.name);
    for (const double value : row.values) text += ',', append_shortest(text, value);
    text += '\n';
  }
  return text;
}

std::string json_of(const Table& table) {
  using Json = nlohmann::ordered_json;
  const auto quoted = [](const std::string& name) {
    return Json(name).dump(-1, ' ', false, Json::error_handler_t::replace);
  };
  std::string text = "{\n  \"columns\": [";
  for (std::size_t c = 0; c < table.columns.size(); ++c) text += (c ? ", " : "") + quoted(table.columns[c]);
  text += "],\n  \"rows\": {";
  std::set<std::string> names;
  for (const TableRow& row : table.rows) {
    check(names.insert(row.name).second, "the table has two rows ", row.name, ", which JSON cannot hold");
    text += (names.size() > 1 ? ",\n    " : "\n    ") + quoted(row.name) + ": [";
    for (std::size_t c = 0; c < row.values.size(); ++c) {
      if (c > 0) text += ", ";
      if (std::isfinite(row.values[c]))
        append_shortest(text, row.values[c]);
      else
        text += "null";
    }
    text += ']';
  }
  return text + "\n  }\n}\n";
}

}  // namespace

engine::File export_table(const Table& table, const ExportTableOptions& options) {
  for (const TableRow& row : table.rows)
    check(row.values.size() == table.columns.size(), "row ", row.name, " has ", row.values.size(), " values, expected ",
          table.columns.size());
  const bool csv = options.format == TableFormat::csv;
  return engine::File::from_bytes(csv ? csv_of(table) : json_of(table), csv ? ".csv" : ".json");
}

}  // namespace face::exports
