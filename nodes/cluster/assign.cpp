// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/assign.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/base/check.h"

namespace face::cluster {

void check_points(const Matrix& points, const char* name) {
  check(points.values.size() == points.rows * points.columns, name, " holds ", points.values.size(),
        " numbers, expected ", points.rows, " x ", points.columns);
  constexpr double most = 1e15;  // squared distances are kept as float
  for (std::size_t i = 0; i < points.values.size(); ++i)
    if (!(std::abs(points.values[i]) <= most))
      fail(name, " holds ", points.values[i], " in row ", i / points.columns, " column ", i % points.columns,
           ", expected finite numbers of at most 1e15 in size");
}

double squared_distance(const Matrix& points, std::size_t a, std::size_t b) {
  const double* p = &points.values[a * points.columns];
  const double* q = &points.values[b * points.columns];
  double sum = 0;
  for (std::size_t d = 0; d < points.columns; ++d) sum += (p[d] - q[d]) * (p[d] - q[d]);
  return sum;
}

Assignment assign(const Matrix& points, std::vector<std::size_t> exemplars) {
  std::sort(exemplars.begin(), exemplars.end());
  Assignment result{std::move(exemplars), std::vector<std::size_t>(points.rows)};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.rows, 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < result.exemplars.size(); ++k) {
        const double distance = squared_distance(points, i, result.exemplars[k]);
        if (distance < least) {
          least = distance;
          result.labels[i] = k;
        }
      }
    }
  });
  for (std::size_t k = 0; k < result.exemplars.size(); ++k) result.labels[result.exemplars[k]] = k;
  return result;
}

Assignment improve_medoids(const Matrix& points, Assignment assignment, std::size_t rounds) {
  for (std::size_t round = 0; round < rounds; ++round) {
    std::vector<std::vector<std::size_t>> groups(assignment.exemplars.size());
    for (std::size_t i = 0; i < points.rows; ++i) groups[assignment.labels[i]].push_back(i);
    std::vector<std::size_t> medoids = assignment.exemplars;
    // Sums of squared distances need no pairs: |x|^2 n - 2 x . sum + a constant, about the group's mean.
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t k) {
      std::vector<double> mean(points.columns, 0.0);
      for (const std::size_t i : groups[k])
        for (std::size_t d = 0; d < points.columns; ++d) mean[d] += points.at(i, d);
      for (double& value : mean) value /= static_cast<double>(groups[k].size());
      const auto distance = [&](std::size_t i) {
        double sum = 0;
        for (std::size_t d = 0; d < points.columns; ++d)
          sum += (points.at(i, d) - mean[d]) * (points.at(i, d) - mean[d]);
        return sum;
      };
      double least = distance(medoids[k]);
      for (const std::size_t i : groups[k]) {
        const double here = distance(i);
        if (here >= least) continue;
        least = here;
        medoids[k] = i;
      }
    });
    if (medoids == assignment.exemplars) break;
    assignment = assign(points, std::move(medoids));
  }
  return assignment;
}

double net_similarity(const Matrix& points, const Assignment& assignment, double preference) {
  double sum = preference * static_cast<double>(assignment.exemplars.size());
  for (std::size_t i = 0; i < points.rows; ++i)
    sum -= squared_distance(points, i, assignment.exemplars[assignment.labels[i]]);
  return sum;
}

}  // namespace face::cluster
