// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>


namespace face::evaluate {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double mean_of(const std::vector<double>& values) {
  if (values.empty()) return nothing;
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double rms_of(const std::vector<double>& values) {
  if (values.empty()) return nothing;
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double largest_of(const std::vector<double>& values) {
  return values.empty() ? nothing : *std::max_element(values.begin(), values.end());
}

double deviation_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  std::vector<double> centred = values;
  for (double& value : centred) value -= mean;
  return rms_of(centred);
}

double percent_within(const std::vector<double>& values, double most) {
  double count = 0;
  for (const double value : values) count += value <= most ? 1 : 0;
  return percent_of(count, static_cast<double>(values.size()));
}

double percent_of(double part, double whole) { return whole == 0 ? nothing : 100 * part / whole; }

Table one_row(std::string name, std::vector<std::string> columns, std::vector<double> values) {
  Table table;
  table.columns = std::move(columns);
  table.rows.push_back({std::move(name), std::move(values)});
  return table;
}

}  // namespace face::evaluate
