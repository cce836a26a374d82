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

// Exemplars without the one whose points lose least by going to their second nearest.
std::vector<std::size_t> without_cheapest(const Assignment& assignment, const Nearest& nearest) {
  std::vector<double> loss(assignment.exemplars.size(), 0.0);
  for (std::size_t i = 0; i < assignment.labels.size(); ++i)
    loss[assignment.labels[i]] += nearest.second[i] - nearest.first[i];
  std::vector<std::size_t> exemplars = assignment.exemplars;
  exemplars.erase(exemplars.begin() + (std::min_element(loss.begin(), loss.end()) - loss.begin()));
  return exemplars;
}

// Of every group the candidate that would bring all points nearer by most, the best groups first. A candidate is seldom
// in the middle of the points that it would win, so that what it would really be worth is more.
std::vector<std::size_t> promising_candidates(const Similarities& similarities, const Assignment& assignment,
                                              const Nearest& nearest) {
  constexpr std::size_t rows_per_block = 1024;
  const std::size_t rows = similarities.rows(), columns = similarities.columns();
  const std::size_t blocks = (rows + rows_per_block - 1) / rows_per_block;
  std::vector<std::vector<double>> gains(blocks, std::vector<double>(columns, 0.0));
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t end = std::min((block + 1) * rows_per_block, rows);
    for (std::size_t i = block * rows_per_block; i < end; ++i)
      for (std::size_t k = 0; k < columns; ++k) {
        // A candidate's own entry is the preference; its distance is 0.
        const double distance = k == similarities.own(i) ? 0 : -static_cast<double>(similarities.row(i)[k]);
        gains[block][k] += std::max(0.0, nearest.first[i] - distance);
      }
  });
  std::vector<double> best(assignment.exemplars.size(), 0.0);
  std::vector<std::size_t> candidate(best.size(), rows), order;
  for (std::size_t k = 0; k < columns; ++k) {
    double gain = 0;
    for (const std::vector<double>& part : gains) gain += part[k];
    const std::size_t point = similarities.candidates()[k], group = assignment.labels[point];
    if (gain <= best[group] || point == assignment.exemplars[group]) continue;
    best[group] = gain;
    candidate[group] = point;
  }
  for (std::size_t g = 0; g < best.size(); ++g)
    if (candidate[g] < rows) order.push_back(g);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return best[a] > best[b]; });
  for (std::size_t& g : order) g = candidate[g];
  return order;
}

// The exchange of one exemplar for one candidate that brings the points nearer by most, all pairs tried (Schubert and
// Rousseeuw, Fast and Eager k-Medoids Clustering, Information Systems 101, 2021). Empty where none does.
std::vector<std::size_t> best_swap(const Similarities& similarities, const Assignment& assignment,
                                   const Nearest& nearest) {
  constexpr std::size_t rows_per_block = 2048;
  const std::size_t rows = similarities.rows(), columns = similarities.columns(), groups = assignment.exemplars.size();
  const std::size_t blocks = (rows + rows_per_block - 1) / rows_per_block, width = groups + 1;
  // Per candidate: what exchanging each exemplar costs, and last what the candidate alone saves.
  std::vector<std::vector<double>> parts(blocks, std::vector<double>(columns * width, 0.0));
  std::vector<double> removal(groups, 0.0);
  for (std::size_t i = 0; i < rows; ++i) removal[assignment.labels[i]] += nearest.second[i] - nearest.first[i];
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t end = std::min((block + 1) * rows_per_block, rows);
    for (std::size_t i = block * rows_per_block; i < end; ++i) {
      const double first = nearest.first[i], second = nearest.second[i];
      const std::size_t label = assignment.labels[i];
      for (std::size_t k = 0; k < columns; ++k) {
        const double distance = k == similarities.own(i) ? 0 : -static_cast<double>(similarities.row(i)[k]);
        if (distance >= second) continue;
        double* cost = &parts[block][k * width];
        if (distance < first) {
          cost[groups] += distance - first;
          cost[label] += first - second;
        } else {
          cost[label] += distance - second;
        }
      }
    }
  });
  double least = 0;
  std::size_t comes = columns, goes = 0;
  for (std::size_t k = 0; k < columns; ++k)
    for (std::size_t g = 0; g < groups; ++g) {
      double cost = removal[g];
      for (const std::vector<double>& part : parts) cost += part[k * width + g] + part[k * width + groups];
      if (cost >= least) continue;
      least = cost;
      comes = k;
      goes = g;
    }
  if (comes == columns) return {};
  std::vector<std::size_t> exemplars = assignment.exemplars;
  exemplars[goes] = similarities.candidates()[comes];
  return exemplars;
}

}  // namespace

std::vector<std::size_t> central_candidates(const Matrix& points, const Assignment& assignment, std::size_t count) {
  const std::size_t groups = assignment.exemplars.size(), dims = points.columns;
  std::vector<double> means(groups * dims, 0.0), sizes(groups, 0.0);
  for (std::size_t i = 0; i < points.rows; ++i) {
    sizes[assignment.labels[i]] += 1;
    for (std::size_t d = 0; d < dims; ++d) means[assignment.labels[i] * dims + d] += points.at(i, d);
  }
  std::vector<std::vector<std::pair<double, std::size_t>>> members(groups);
  for (std::size_t i = 0; i < points.rows; ++i) {
    const std::size_t g = assignment.labels[i];
    double sum = 0;
    for (std::size_t d = 0; d < dims; ++d) {
      const double difference = points.at(i, d) - means[g * dims + d] / sizes[g];
      sum += difference * difference;
    }
    members[g].push_back({sum, i});
  }
  std::vector<std::size_t> chosen = assignment.exemplars;
  const std::size_t each = std::max<std::size_t>(1, count / groups);
  for (std::vector<std::pair<double, std::size_t>>& group : members) {
    std::sort(group.begin(), group.end());
    for (std::size_t m = 0; m < std::min(each, group.size()); ++m) chosen.push_back(group[m].second);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

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
  constexpr std::size_t medoid_rounds = 10, most_changes = 1000, most_tries = 64;
  assignment = improve_medoids(points, std::move(assignment), medoid_rounds);
  double best = net_similarity(points, assignment, preference);
  const auto accept = [&](std::vector<std::size_t> exemplars) {
    Assignment next = improve_medoids(points, assign(points, std::move(exemplars)), medoid_rounds);
    const double similarity = net_similarity(points, next, preference);
    if (similarity <= best) return false;
    best = similarity;
    assignment = std::move(next);
    return true;
  };
  for (std::size_t change = 0; change < most_changes; ++change) {
    const Nearest nearest = find_nearest(points, assignment);
    if (assignment.exemplars.size() > 1) {
      if (accept(without_cheapest(assignment, nearest))) continue;
      std::vector<std::size_t> swapped = best_swap(similarities, assignment, nearest);
      if (!swapped.empty() && accept(std::move(swapped))) continue;
    }
    const std::vector<std::size_t> candidates = promising_candidates(similarities, assignment, nearest);
    bool changed = false;
    for (std::size_t i = 0; i < std::min(most_tries, candidates.size()) && !changed; ++i) {
      std::vector<std::size_t> exemplars = assignment.exemplars;
      exemplars.push_back(candidates[i]);
      changed = accept(std::move(exemplars));
    }
    if (!changed) break;
  }
  return improve_medoids(points, std::move(assignment), most_changes);
}

}  // namespace face::cluster
