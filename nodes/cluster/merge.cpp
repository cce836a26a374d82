// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/merge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nodes/base/check.h"
#include "nodes/base/nnls.h"
#include "nodes/cluster/assign.h"

namespace face::cluster {
namespace {

Assignment read_assignment(const Matrix& points, const Matrix& labels, const Matrix& exemplars) {
  check(labels.values.size() == points.rows, "labels has ", labels.values.size(), " numbers, expected ", points.rows,
        " as points has rows");
  check(!exemplars.values.empty(), "exemplars has no numbers, expected at least 1");
  const auto read = [](const Matrix& matrix, std::size_t limit, const char* name) {
    std::vector<std::size_t> numbers;
    for (const double value : matrix.values) {
      check(value >= 0 && value < static_cast<double>(limit) && value == std::floor(value), name, " holds ", value,
            ", expected a whole number from 0 to ", limit - 1);
      numbers.push_back(static_cast<std::size_t>(value));
    }
    return numbers;
  };
  return {read(exemplars, points.rows, "exemplars"), read(labels, exemplars.values.size(), "labels")};
}

double reconstruction_error(const Matrix& points, const std::vector<double>& neutral,
                            const std::vector<std::size_t>& exemplars) {
  const std::size_t dims = points.columns, count = exemplars.size();
  Matrix basis{dims, count, std::vector<double>(dims * count)};
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t d = 0; d < dims; ++d) basis.at(d, k) = points.at(exemplars[k], d) - neutral[d];
  NonNegativeLeastSquares solver(basis);
  std::vector<double> target(dims), weights(count);
  double squares = 0;
  for (std::size_t i = 0; i < points.rows; ++i) {
    for (std::size_t d = 0; d < dims; ++d) target[d] = points.at(i, d) - neutral[d];
    solver.solve(target.data(), weights.data());
    for (std::size_t d = 0; d < dims; ++d) {
      double rest = target[d];
      for (std::size_t k = 0; k < count; ++k) rest -= basis.at(d, k) * weights[k];
      squares += rest * rest;
    }
  }
  return std::sqrt(squares / static_cast<double>(points.values.size()));
}

// Joins the two groups with the nearest exemplars; the distance between these.
double merge_nearest(const Matrix& points, Assignment& groups) {
  std::vector<std::size_t> sizes(groups.exemplars.size(), 0);
  for (const std::size_t label : groups.labels) ++sizes[label];
  double least = std::numeric_limits<double>::infinity();
  std::size_t keeps = 0, goes = 1;
  for (std::size_t a = 0; a < groups.exemplars.size(); ++a)
    for (std::size_t b = a + 1; b < groups.exemplars.size(); ++b) {
      const double distance = squared_distance(points, groups.exemplars[a], groups.exemplars[b]);
      if (distance >= least) continue;
      least = distance;
      keeps = sizes[b] > sizes[a] ? b : a;
      goes = sizes[b] > sizes[a] ? a : b;
    }
  for (std::size_t& label : groups.labels) {
    if (label == goes) label = keeps;
    if (label > goes) --label;
  }
  groups.exemplars.erase(groups.exemplars.begin() + static_cast<std::ptrdiff_t>(goes));
  return std::sqrt(least);
}

}  // namespace

MergeResult merge(const Matrix& points, const Matrix& labels, const Matrix& exemplars, const Matrix* neutral,
                  const MergeOptions& options) {
  check_points(points, "points");
  Assignment groups = read_assignment(points, labels, exemplars);
  std::vector<double> rest(points.columns, 0.0);
  if (neutral) {
    check_points(*neutral, "neutral");
    check(neutral->values.size() == points.columns, "neutral has ", neutral->values.size(), " numbers, expected ",
          points.columns, " as points has columns");
    rest = neutral->values;
  } else {
    for (std::size_t i = 0; i < points.rows; ++i)
      for (std::size_t d = 0; d < points.columns; ++d) rest[d] += points.at(i, d) / static_cast<double>(points.rows);
  }
  constexpr std::size_t most_judged = 63;  // key shapes that NonNegativeLeastSquares takes
  while (groups.exemplars.size() > most_judged) merge_nearest(points, groups);
  const std::size_t most = groups.exemplars.size();
  std::vector<Assignment> steps(most + 1);  // by the number of groups
  std::vector<double> errors(most + 1), distances(most + 1, 0.0);
  for (std::size_t count = most; count > 0; --count) {
    steps[count] = groups;
    errors[count] = reconstruction_error(points, rest, groups.exemplars);
    if (count > 1) distances[count - 1] = merge_nearest(points, groups);
  }
  MergeResult result;
  result.curve.columns = {"groups", "distance_merged", "error"};
  for (std::size_t count = 1; count <= most; ++count)
    result.curve.rows.push_back({std::to_string(count), {static_cast<double>(count), distances[count], errors[count]}});
  constexpr double share = 0.1;
  const double least = *std::min_element(errors.begin() + 1, errors.end());
  std::size_t knee = 1;
  while (knee < most && errors[knee] > least + share * (errors[1] - least)) ++knee;
  result.knee = static_cast<std::int64_t>(knee);
  std::size_t kept = options.groups > 0 ? std::min(most, static_cast<std::size_t>(options.groups)) : knee;
  // distances[c] is what merging c + 1 groups into c cost.
  while (kept > 1 && distances[kept - 1] < options.max_distance) --kept;
  // In the order of their points, as affinity_propagation has them.
  Assignment chosen = steps[kept];
  std::vector<std::size_t> sorted = chosen.exemplars;
  std::sort(sorted.begin(), sorted.end());
  for (const std::size_t label : chosen.labels) {
    const auto place = std::lower_bound(sorted.begin(), sorted.end(), chosen.exemplars[label]);
    result.labels.values.push_back(static_cast<double>(place - sorted.begin()));
  }
  result.labels.rows = points.rows;
  result.labels.columns = 1;
  result.exemplars = {sorted.size(), 1, std::vector<double>(sorted.begin(), sorted.end())};
  return result;
}

}  // namespace face::cluster
