// SPDX-License-Identifier: Apache-2.0
#include "nodes/cluster/k_medoids.h"

#include "nodes/cluster/assign.h"
#include "nodes/cluster/seed_groups.h"

namespace face::cluster {

KMedoidsResult k_medoids(const Matrix& points, const KMedoidsOptions& options) {
  check_points(points, "points");
  KMedoidsResult result;
  for (std::int64_t run = 0; run < options.restarts; ++run) {
    constexpr std::size_t most_rounds = 1000;
    const Assignment found =
        improve_medoids(points,
                        assign(points, seed_groups(points, static_cast<std::size_t>(options.groups),
                                                   static_cast<std::uint64_t>(options.seed * options.restarts + run))),
                        most_rounds);
    const double error = -net_similarity(points, found, 0);
    if (run > 0 && error >= result.error) continue;
    result.error = error;
    result.labels = {points.rows, 1, std::vector<double>(found.labels.begin(), found.labels.end())};
    result.exemplars = {found.exemplars.size(), 1, std::vector<double>(found.exemplars.begin(), found.exemplars.end())};
  }
  return result;
}

}  // namespace face::cluster
