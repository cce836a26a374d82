// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/affinity_pruned.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "nodes/base/random.h"

namespace face::cluster {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Squared distance of every point to its nearest and second nearest exemplar.
struct Nearest {
  std::vector<double> first, second;
};
Nearest find_nearest(const Matrix& points, const Assignment& assignment) {
  Nearest nearest{std::vector<double>(points.rows, 0.0), std::vector<double>(points.rows, infinity)};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.rows, 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      for (std::size_t k = 0; k < assignment.exemplars.size(); ++k) {
        const double distance = squared_distance(points, i, assignment.exemplars[k]);
        if (k == assignment.labels[i])
          nearest.first[i] = distance;
        else
          nearest.second[i] = std::min(nearest.second[i], distance);
      }
  });
  return nearest;
}

// Takes away the exemplar whose points lose least by going to their second nearest, if that is less than its price.
bool give_up_one(const Matrix& points, double price, Assignment& assignment) {
  if (assignment.exemplars.size() < 2) return false;
  const Nearest nearest = find_nearest(points, assignment);
  std::vector<double> loss(assignment.exemplars.size(), 0.0);
  for (std::size_t i = 0; i < points.rows; ++i)
    loss[assignment.labels[i]] += std::max(0.0, nearest.second[i] - nearest.first[i]);
  const auto least = std::min_element(loss.begin(), loss.end());
  if (*least >= price) return false;
  std::vector<std::size_t> exemplars = assignment.exemplars;
  exemplars.erase(exemplars.begin() + (least - loss.begin()));
  assignment = assign(points, std::move(exemplars));
  return true;
}

// Adds the candidate that brings the points nearer by most, if that is more than its price.
bool take_in_one(const Matrix& points, const Similarities& similarities, double price, Assignment& assignment) {
  const Nearest nearest = find_nearest(points, assignment);
  constexpr std::size_t rows_per_block = 1024;
  const std::size_t columns = similarities.columns(), blocks = (points.rows + rows_per_block - 1) / rows_per_block;
  std::vector<std::vector<double>> gains(blocks, std::vector<double>(columns, 0.0));
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t end = std::min((block + 1) * rows_per_block, points.rows);
    for (std::size_t i = block * rows_per_block; i < end; ++i)
      for (std::size_t k = 0; k < columns; ++k) {
        // A candidate's own entry is the preference; its distance is 0.
        const double distance = k == similarities.own(i) ? 0 : -static_cast<double>(similarities.row(i)[k]);
        gains[block][k] += std::max(0.0, nearest.first[i] - distance);
      }
  });
  std::vector<double> gain(columns, 0.0);
  for (const std::vector<double>& part : gains)
    for (std::size_t k = 0; k < columns; ++k) gain[k] += part[k];
  const auto most = std::max_element(gain.begin(), gain.end());
  if (most == gain.end() || *most <= price * (1 + 1e-6)) return false;
  std::vector<std::size_t> exemplars = assignment.exemplars;
  const std::size_t candidate = similarities.candidates()[static_cast<std::size_t>(most - gain.begin())];
  if (std::find(exemplars.begin(), exemplars.end(), candidate) != exemplars.end()) return false;
  exemplars.push_back(candidate);
  assignment = assign(points, std::move(exemplars));
  return true;
}

}  // namespace

std::vector<std::size_t> spread_candidates(const Matrix& points, std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> chosen;
  if (count >= points.rows) {
    for (std::size_t i = 0; i < points.rows; ++i) chosen.push_back(i);
    return chosen;
  }
  std::vector<double> mean(points.columns, 0.0), distance(points.rows, 0.0);
  for (std::size_t i = 0; i < points.rows; ++i)
    for (std::size_t d = 0; d < points.columns; ++d) mean[d] += points.at(i, d) / static_cast<double>(points.rows);
  for (std::size_t i = 0; i < points.rows; ++i)
    for (std::size_t d = 0; d < points.columns; ++d)
      distance[i] += (points.at(i, d) - mean[d]) * (points.at(i, d) - mean[d]);
  std::vector<bool> taken(points.rows, false);
  for (std::size_t n = 0; n < count / 2; ++n) {
    const auto farthest =
        static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
    if (taken[farthest]) break;  // every point lies on one that was chosen
    taken[farthest] = true;
    chosen.push_back(farthest);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.rows, 1024), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const double here = squared_distance(points, i, farthest);
        distance[i] = n == 0 ? here : std::min(distance[i], here);
      }
    });
  }
  Random random(seed);
  while (chosen.size() < count) {
    const auto point = static_cast<std::size_t>(random.bits() % points.rows);
    if (taken[point]) continue;
    taken[point] = true;
    chosen.push_back(point);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

Assignment improve_locally(const Matrix& points, const Similarities& similarities, Assignment assignment,
                           double preference) {
  constexpr std::size_t medoid_rounds = 20, most_changes = 1000;
  assignment = improve_medoids(points, std::move(assignment), medoid_rounds);
  for (std::size_t change = 0; change < most_changes; ++change) {
    const double before = net_similarity(points, assignment, preference);
    Assignment next = assignment;
    if (!give_up_one(points, -preference, next) && !take_in_one(points, similarities, -preference, next)) break;
    next = improve_medoids(points, std::move(next), medoid_rounds);
    if (net_similarity(points, next, preference) <= before) break;
    assignment = std::move(next);
  }
  return assignment;
}

}  // namespace face::cluster
