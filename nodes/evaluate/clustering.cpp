// SPDX-License-Identifier: Apache-2.0
#include "nodes/evaluate/clustering.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "nodes/base/check.h"
#include "nodes/evaluate/statistics.h"

namespace face::evaluate {
namespace {

std::vector<std::int64_t> whole_numbers(const Matrix& matrix, std::size_t rows, const char* name) {
  check(matrix.rows == rows && matrix.columns == 1 && matrix.values.size() == rows, name, " is ", matrix.rows, " x ",
        matrix.columns, ", expected ", rows, " x 1");
  std::vector<std::int64_t> numbers;
  for (std::size_t i = 0; i < rows; ++i) {
    const double value = matrix.values[i];
    check(std::abs(value) < 1e15 && value == std::floor(value), name, ": row ", i, " is ", value,
          ", expected a whole number");
    numbers.push_back(static_cast<std::int64_t>(value));
  }
  return numbers;
}

struct Recall {
  double groups = 0, found = 0, small_groups = 0, small_found = 0, small_with_exemplar = 0;
};

Recall recall_of(const std::vector<std::int64_t>& labels, const std::vector<std::int64_t>& exemplars,
                 const std::vector<std::int64_t>& planted, double small) {
  std::map<std::int64_t, double> own_sizes, sizes;
  std::map<std::pair<std::int64_t, std::int64_t>, double> common;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    ++own_sizes[labels[i]];
    ++sizes[planted[i]];
    ++common[{planted[i], labels[i]}];
  }
  std::set<std::int64_t> hit, with_exemplar;
  for (const auto& [pair, both] : common)
    if (both / (sizes[pair.first] + own_sizes[pair.second] - both) >= 0.5) hit.insert(pair.first);
  for (const std::int64_t e : exemplars) with_exemplar.insert(planted[static_cast<std::size_t>(e)]);
  Recall recall;
  for (const auto& [group, size] : sizes) {
    ++recall.groups;
    recall.found += hit.contains(group) ? 1 : 0;
    if (size > small) continue;
    ++recall.small_groups;
    recall.small_found += hit.contains(group) ? 1 : 0;
    recall.small_with_exemplar += with_exemplar.contains(group) ? 1 : 0;
  }
  return recall;
}

}  // namespace

Table clustering(const Matrix& points, const Matrix& labels, const Matrix& exemplars, const Matrix* planted,
                 const double& preference, const ClusteringOptions& options) {
  check(points.rows > 0 && points.columns > 0 && points.values.size() == points.rows * points.columns, "points is ",
        points.rows, " x ", points.columns, " with ", points.values.size(), " numbers, expected at least 1 x 1");
  check(std::isfinite(preference), "preference is ", preference, ", expected a finite number");
  for (std::size_t i = 0; i < points.values.size(); ++i)
    check(std::isfinite(points.values[i]), "points: row ", i / points.columns, ", column ", i % points.columns, " is ",
          points.values[i], ", expected a finite number");
  const std::vector<std::int64_t> groups = whole_numbers(labels, points.rows, "labels");
  const std::vector<std::int64_t> middles = whole_numbers(exemplars, exemplars.rows, "exemplars");
  for (std::size_t k = 0; k < middles.size(); ++k)
    check(middles[k] >= 0 && static_cast<std::size_t>(middles[k]) < points.rows, "exemplars: row ", k, " is ",
          middles[k], ", expected a point from 0 to ", points.rows - 1);
  double similarity = preference * static_cast<double>(middles.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    check(groups[i] >= 0 && static_cast<std::size_t>(groups[i]) < middles.size(), "labels: row ", i, " is ", groups[i],
          ", but there are ", middles.size(), " exemplars");
    const auto e = static_cast<std::size_t>(middles[static_cast<std::size_t>(groups[i])]);
    for (std::size_t d = 0; d < points.columns; ++d) {
      const double difference = points.at(i, d) - points.at(e, d);
      similarity -= difference * difference;
    }
  }
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values = {similarity, static_cast<double>(middles.size()), nothing, nothing, nothing, nothing};
  if (planted) {
    const Recall recall = recall_of(groups, middles, whole_numbers(*planted, points.rows, "planted"), options.small);
    values[2] = recall.small_groups;
    values[3] = percent_of(recall.found, recall.groups);
    values[4] = percent_of(recall.small_found, recall.small_groups);
    values[5] = percent_of(recall.small_with_exemplar, recall.small_groups);
  }
  return one_row(
      "all",
      {"net_similarity", "groups", "small_groups", "recall_percent", "small_recall_percent", "exemplar_recall_percent"},
      values);
}

}  // namespace face::evaluate
