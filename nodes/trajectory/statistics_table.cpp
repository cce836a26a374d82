// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/statistics_table.h"

#include <cmath>

#include "nodes/base/check.h"

namespace face::trajectory {

Table statistics_table(const PhoneStatistics& statistics) {
  const std::size_t dimensions = statistics.all.mean.size();
  Table table;
  table.columns = {"frames"};
  for (std::size_t k = 0; k < dimensions; ++k) table.columns.push_back("mean_" + std::to_string(k));
  for (std::size_t k = 0; k < dimensions; ++k) table.columns.push_back("deviation_" + std::to_string(k));
  const auto add = [&](const std::string& name, const PhoneStatistic& phone) {
    check(phone.mean.size() == dimensions && phone.covariance.size() == dimensions * dimensions, "phone ", name,
          " has ", phone.mean.size(), " means and ", phone.covariance.size(), " covariances, expected ", dimensions,
          " and ", dimensions * dimensions);
    TableRow row{name, {static_cast<double>(phone.frames)}};
    row.values.insert(row.values.end(), phone.mean.begin(), phone.mean.end());
    for (std::size_t k = 0; k < dimensions; ++k) row.values.push_back(std::sqrt(phone.covariance[k * dimensions + k]));
    table.rows.push_back(std::move(row));
  };
  for (const PhoneStatistic& phone : statistics.phones) add(phone.label, phone);
  add("all", statistics.all);
  return table;
}

}  // namespace face::trajectory
