// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/number_differences.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "nodes/evaluate/statistics.h"
#include "nodes/types/arkit.h"

namespace face::evaluate {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double far = std::numeric_limits<double>::infinity();

// |b - a|, where equal infinities and two NaN are equal, and NaN is infinitely far from a number.
double apart(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double d = std::abs(b - a);
  return std::isnan(d) ? far : d;
}

std::string weight_name(std::size_t index) {
  return index < arkit_names.size() ? std::string(arkit_names[index]) : "shape " + std::to_string(index);
}

std::size_t position_of(const std::vector<std::string>& list, const std::string& name) {
  return static_cast<std::size_t>(std::find(list.begin(), list.end(), name) - list.begin());
}

}  // namespace

Table weights_difference(const Weights& a, const Weights& b) {
  Table table{{"largest", "rms", "a", "b"}, {{"all", {}}}};
  std::vector<double> differences;
  const std::size_t count = std::max(a.values.size(), b.values.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double x = i < a.values.size() ? a.values[i] : 0, y = i < b.values.size() ? b.values[i] : 0;
    differences.push_back(apart(x, y));
    if (differences.back() > 0) table.rows.push_back({weight_name(i), {differences.back(), differences.back(), x, y}});
  }
  table.rows[0].values = {differences.empty() ? 0 : largest_of(differences),
                          differences.empty() ? 0 : rms_of(differences), nothing, nothing};
  return table;
}

Table table_difference(const Table& a, const Table& b) {
  Table table{{"largest", "only_in_a", "only_in_b"}, {{"all", {}}}};
  std::vector<std::pair<std::size_t, std::size_t>> columns;
  double only_a = 0, only_b = 0;
  for (std::size_t c = 0; c < a.columns.size(); ++c) {
    const std::size_t other = position_of(b.columns, a.columns[c]);
    if (other == b.columns.size()) {
      ++only_a;
      continue;
    }
    columns.emplace_back(c, other);
    table.columns.push_back(a.columns[c]);
  }
  for (const std::string& column : b.columns) only_b += position_of(a.columns, column) == a.columns.size();
  // The first row of a name stands beside the first of that name, the second beside the second.
  std::map<std::string, std::vector<std::size_t>> others;
  for (std::size_t r = b.rows.size(); r-- > 0;) others[b.rows[r].name].push_back(r);
  std::vector<double> largest(columns.size(), 0);
  for (const TableRow& row : a.rows) {
    std::vector<std::size_t>& beside = others[row.name];
    if (beside.empty()) {
      ++only_a;
      continue;
    }
    const std::size_t other = beside.back();
    beside.pop_back();
    TableRow line{row.name, {0, nothing, nothing}};
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto [i, j] = columns[c];
      const double x = i < row.values.size() ? row.values[i] : nothing;
      const double y = j < b.rows[other].values.size() ? b.rows[other].values[j] : nothing;
      const double d = apart(x, y);
      largest[c] = std::max(largest[c], d);
      line.values[0] = std::max(line.values[0], d);
      line.values.push_back(d == 0 ? 0 : y - x);
    }
    if (line.values[0] > 0) table.rows.push_back(std::move(line));
  }
  for (const auto& [name, left] : others) only_b += static_cast<double>(left.size());
  std::vector<double>& all = table.rows[0].values;
  all = {largest.empty() ? 0 : largest_of(largest), only_a, only_b};
  all.insert(all.end(), largest.begin(), largest.end());
  return table;
}

Table matrix_difference(const Matrix& a, const Matrix& b) {
  const std::vector<std::string> columns = {"largest", "rms", "row", "column"};
  if (a.rows != b.rows || a.columns != b.columns || a.values.size() != b.values.size())
    return one_row("all", columns, {nothing, nothing, nothing, nothing});
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.values.size(); ++i) differences.push_back(apart(a.values[i], b.values[i]));
  if (differences.empty()) return one_row("all", columns, {0, 0, nothing, nothing});
  const auto at =
      static_cast<std::size_t>(std::max_element(differences.begin(), differences.end()) - differences.begin());
  return one_row(
      "all", columns,
      {differences[at], rms_of(differences), static_cast<double>(at / a.columns), static_cast<double>(at % a.columns)});
}

Table audio_difference(const Audio& a, const Audio& b) {
  const std::vector<std::string> columns = {"rms", "largest", "level_db", "longer_s"};
  const double longer_s = b.duration_s() - a.duration_s();
  if (a.rate_hz != b.rate_hz) return one_row("all", columns, {nothing, nothing, nothing, longer_s});
  std::vector<double> differences, levels;
  for (std::size_t i = 0; i < std::min(a.samples.size(), b.samples.size()); ++i) {
    differences.push_back(apart(a.samples[i], b.samples[i]));
    levels.push_back(a.samples[i]);
  }
  const double rms = differences.empty() ? 0 : rms_of(differences), own = levels.empty() ? 0 : rms_of(levels);
  return one_row("all", columns,
                 {rms, differences.empty() ? 0 : largest_of(differences), 20 * std::log10(rms / own), longer_s});
}

Table flow_difference(const FlowField& a, const FlowField& b) {
  const std::vector<std::string> columns = {"mean_px", "p95_px", "largest_px", "only_in_a", "only_in_b"};
  const std::size_t pixels = a.displacement_px.size();
  if (a.width != b.width || a.height != b.height || b.displacement_px.size() != pixels || a.valid.size() != pixels ||
      b.valid.size() != pixels)
    return one_row("all", columns, std::vector<double>(columns.size(), nothing));
  std::vector<double> distances;
  double only_a = 0, only_b = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    only_a += a.valid[i] && !b.valid[i];
    only_b += b.valid[i] && !a.valid[i];
    if (a.valid[i] && b.valid[i])
      distances.push_back(std::hypot(double(a.displacement_px[i][0]) - b.displacement_px[i][0],
                                     double(a.displacement_px[i][1]) - b.displacement_px[i][1]));
  }
  return one_row("all", columns,
                 {mean_of(distances), quantile(distances, 0.95), largest_of(distances), only_a, only_b});
}

}  // namespace face::evaluate
