// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/seed_groups.h"

#include <algorithm>

#include "nodes/base/check.h"
#include "nodes/base/random.h"
#include "nodes/cluster/assign.h"

namespace face::cluster {

std::vector<std::size_t> seed_groups(const Matrix& points, std::size_t count, std::uint64_t seed) {
  check(count >= 1 && count <= points.rows, "there are ", points.rows, " points for ", count, " groups, expected at ",
        "least one point per group");
  Random random(seed);
  std::vector<std::size_t> chosen = {static_cast<std::size_t>(random.bits() % points.rows)};
  std::vector<double> distance(points.rows);
  std::vector<bool> taken(points.rows, false);
  taken[chosen[0]] = true;
  for (std::size_t i = 0; i < points.rows; ++i) distance[i] = squared_distance(points, i, chosen[0]);
  while (chosen.size() < count) {
    double sum = 0;
    for (const double value : distance) sum += value;
    double draw = random.uniform() * sum;
    // Where all distances are 0, the first point that is not taken.
    std::size_t next = points.rows;
    for (std::size_t i = 0; i < points.rows; ++i) {
      if (taken[i]) continue;
      if (next == points.rows || (distance[i] > 0 && draw > 0)) next = i;
      draw -= distance[i];
      if (draw <= 0 && distance[next] > 0) break;
    }
    taken[next] = true;
    chosen.push_back(next);
    for (std::size_t i = 0; i < points.rows; ++i)
      distance[i] = std::min(distance[i], squared_distance(points, i, next));
  }
  return chosen;
}

}  // namespace face::cluster
