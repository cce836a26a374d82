// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/k_means.h"

#include <algorithm>
#include <limits>

#include "nodes/base/check.h"
#include "nodes/cluster/assign.h"
#include "nodes/cluster/seed_groups.h"

namespace face::cluster {

KMeansResult k_means(const Matrix& points, const KMeansOptions& options) {
  check_points(points, "points");
  const std::size_t groups = static_cast<std::size_t>(options.groups), dims = points.columns;
  const std::vector<std::size_t> seeds = seed_groups(points, groups, static_cast<std::uint64_t>(options.seed));
  KMeansResult result;
  result.centres = {groups, dims, {}};
  for (const std::size_t seed : seeds)
    result.centres.values.insert(result.centres.values.end(), &points.values[seed * dims],
                                 &points.values[seed * dims] + dims);
  std::vector<std::size_t> labels(points.rows, groups);
  std::vector<double> distances(points.rows);
  for (std::int64_t round = 0; round < options.max_iterations; ++round) {
    bool changed = false;
    for (std::size_t i = 0; i < points.rows; ++i) {
      std::size_t best = 0;
      distances[i] = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < groups; ++k) {
        double sum = 0;
        for (std::size_t d = 0; d < dims; ++d) {
          const double difference = points.at(i, d) - result.centres.at(k, d);
          sum += difference * difference;
        }
        if (sum < distances[i]) {
          distances[i] = sum;
          best = k;
        }
      }
      changed = changed || labels[i] != best;
      labels[i] = best;
    }
    if (!changed) break;
    std::vector<double> counts(groups, 0.0), sums(groups * dims, 0.0);
    for (std::size_t i = 0; i < points.rows; ++i) {
      counts[labels[i]] += 1;
      for (std::size_t d = 0; d < dims; ++d) sums[labels[i] * dims + d] += points.at(i, d);
    }
    for (std::size_t k = 0; k < groups; ++k)
      if (counts[k] > 0)  // an empty group keeps its centre
        for (std::size_t d = 0; d < dims; ++d) result.centres.at(k, d) = sums[k * dims + d] / counts[k];
  }
  std::vector<double> nearest(groups, std::numeric_limits<double>::infinity());
  result.exemplars = {groups, 1, std::vector<double>(groups)};
  for (std::size_t i = 0; i < points.rows; ++i) {
    result.error += distances[i];
    if (distances[i] >= nearest[labels[i]]) continue;
    nearest[labels[i]] = distances[i];
    result.exemplars.values[labels[i]] = static_cast<double>(i);
  }
  result.labels = {points.rows, 1, std::vector<double>(labels.begin(), labels.end())};
  return result;
}

}  // namespace face::cluster
